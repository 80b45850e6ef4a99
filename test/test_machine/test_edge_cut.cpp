// Paths that lead out of the sled's area are cut where they cross its edges, and never jump.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "machine/edge_cut.h"

using namespace machine;
using motion::Path;
using motion::Point;

namespace {

const Area kSheet = {{-1200, -600}, {1200, 600}};

double apart(Point<float> a, Point<float> b) {
  return std::hypot(double(a.x) - double(b.x), double(a.y) - double(b.y));
}

struct Piece {
  Path<float> path;
  double first, last;  ///< shares of the whole
};

std::vector<Piece> piecesOf(const Path<float>& path, const Area& area) {
  std::vector<Piece> pieces;
  double first = 0;
  for (EdgeCut cut(path, area); cut.next(); first = pieces.back().last)
    pieces.push_back({cut.piece(), first, double(cut.share())});
  return pieces;
}

/// Every place of the pieces against the whole path's places, brought back to the area.
void expectClamped(const Path<float>& path, const Area& area) {
  const std::vector<Piece> pieces = piecesOf(path, area);
  ASSERT_FALSE(pieces.empty());
  EXPECT_EQ(1, pieces.back().last);
  EXPECT_LT(apart(area.clamped(path.to), pieces.back().path.to), 1e-3);
  Point<float> here = area.clamped(path.from);
  for (const Piece& piece : pieces) {
    ASSERT_LE(apart(here, piece.path.from), 1e-6) << "a jump";
    here = piece.path.to;
    for (int k = 0; k <= 40; ++k) {
      const float share = float(k) / 40;
      const float of_all = float(piece.first + (piece.last - piece.first) * double(share));
      const Point<float> whole = motion::placeOn(path, of_all);
      const Point<float> found = motion::placeOn(piece.path, share);
      ASSERT_TRUE(area.nearlyHolds(found, 0.01f));
      // Along the edge an arc leaves out the way there and back.
      if (path.sweep == 0 || area.nearlyHolds(whole, -0.01f)) {
        ASSERT_LT(apart(area.clamped(whole), found), 0.02) << of_all;
      }
    }
  }
}

class Random {
 public:
  float between(double low, double high) {
    return float(std::uniform_real_distribution<double>(low, high)(random_));
  }
  Point<float> place() { return {between(-2500, 2500), between(-1500, 1500)}; }

 private:
  std::mt19937 random_{3};
};

}  // namespace

TEST(EdgeCut, LeavesAPathOnTheSheetAlone) {
  const Path<float> path = motion::line(Point<float>{-1200, 0}, Point<float>{300, 600});
  EdgeCut cut(path, kSheet);
  EXPECT_FALSE(cut.leaves());
  ASSERT_TRUE(cut.next());
  EXPECT_EQ(path.to.x, cut.piece().to.x);
  EXPECT_EQ(1, cut.share());
  EXPECT_FALSE(cut.next());
}

TEST(EdgeCut, ALineOfOneMillimetreIsCutLikeAnyOther) {
  const Path<float> paths[] = {motion::line(Point<float>{1199.5f, 0}, Point<float>{1200.5f, 0}),
                               motion::line(Point<float>{0, 599.5f}, Point<float>{0, 600.5f})};
  for (const Path<float>& path : paths) {
    const std::vector<Piece> pieces = piecesOf(path, kSheet);
    ASSERT_EQ(2u, pieces.size()) << "to " << path.to.x << ", " << path.to.y;
    EXPECT_NEAR(0.5, pieces[0].last, 1e-3) << "to " << path.to.x << ", " << path.to.y;
  }
}

TEST(EdgeCut, FollowsAnyLineAsFarAsItIsOnTheSheet) {
  Random random;
  for (int i = 0; i < 3000; ++i)
    expectClamped(motion::line(random.place(), random.place()), kSheet);
}

TEST(EdgeCut, FollowsAnyArcAsFarAsItIsOnTheSheet) {
  Random random;
  int left = 0;
  for (int i = 0; i < 3000; ++i) {
    const Point<float> centre = random.place();
    const double radius = double(random.between(1, 900));
    const double first = double(random.between(0, 6.28)), last = double(random.between(0, 6.28));
    const Point<float> from = {centre.x + float(radius * std::cos(first)),
                               centre.y + float(radius * std::sin(first))};
    const Point<float> to = {centre.x + float(radius * std::cos(last)),
                             centre.y + float(radius * std::sin(last))};
    const Path<float> path =
        motion::arc(from, i % 5 ? to : from, centre,
                    i % 2 ? motion::Turn::kClockwise : motion::Turn::kCounterclockwise);
    expectClamped(path, kSheet);
    left += EdgeCut(path, kSheet).leaves();
    if (HasFatalFailure()) FAIL() << i;
  }
  EXPECT_GT(left, 1000);
}

TEST(EdgeCut, AnArcThatOnlyTouchesTheEdgeIsCutWhole) {
  for (float more : {-0.001f, 0.0f, 0.001f}) {
    const Path<float> circle = motion::arc(Point<float>{1000, 0}, Point<float>{1000, 0},
                                           Point<float>{1100 + more, 0}, motion::Turn::kClockwise);
    expectClamped(circle, kSheet);
    double length = 0;
    for (const Piece& piece : piecesOf(circle, kSheet)) length += double(piece.path.length);
    EXPECT_NEAR(2 * M_PI * 100, length, 0.05);
  }
}

TEST(Area, GrowsToThePlaceOfTheSled) {
  const Area grown = kSheet.grownTo({0, -800});
  EXPECT_TRUE(grown.holds({1200, -800}));
  EXPECT_FALSE(grown.holds({0, -801}));
  EXPECT_FALSE(grown.holds({1201, 0}));
  EXPECT_FLOAT_EQ(200, kSheet.distanceTo({0, -800}));
  EXPECT_FLOAT_EQ(50, kSheet.distanceTo({1230, 640}));
  EXPECT_FLOAT_EQ(0, kSheet.distanceTo({1200, 0}));
}
