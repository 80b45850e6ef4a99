// Pulls of both chains hold the sled against its load and any push.
#include <gtest/gtest.h>

#include "hidden.h"

using namespace kinematics;

TEST(PushedBalance, PullsHoldTheLoadAndThePush) {
  const Machine<double> laws = lawsWith({});
  for (const Eigen::Vector2d& at : sheetPlaces()) {
    const Point<double> place = {at.x(), at.y()};
    const Hanging<double> free = hangPushed(laws, place, {0, 0});
    const double load = free.strand[kLeft].pull * free.strand[kLeft].sine +
                        free.strand[kRight].pull * free.strand[kRight].sine;
    EXPECT_NEAR(load, 1, 0.05) << "the sled's weight, and a little chain";
    for (const Point<double>& push :
         {Point<double>{0, 0}, {0.1, 0}, {-0.1, 0}, {0, 0.15}, {0, -0.15}, {0.05, -0.1}}) {
      const Hanging<double> hanging = hangPushed(laws, place, push);
      const Strand<double>& left = hanging.strand[kLeft];
      const Strand<double>& right = hanging.strand[kRight];
      EXPECT_NEAR(left.pull * left.cosine - right.pull * right.cosine, push.x, 1e-9)
          << place.x << " " << place.y << ", push " << push.x << " " << push.y;
      EXPECT_NEAR(left.pull * left.sine + right.pull * right.sine, load - push.y, 1e-9)
          << place.x << " " << place.y << ", push " << push.x << " " << push.y;
      for (const Strand<double>& strand : hanging.strand) {
        EXPECT_NEAR(strand.slack * strand.pull, 1, 1e-9);
        EXPECT_NEAR(strand.bend * strand.pull, strand.cosine, 1e-9);
      }
    }
  }
}
