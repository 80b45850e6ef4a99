// Modes and the beginnings of coordinates.
#include <gtest/gtest.h>

#include "reading.h"

using namespace gcode;

TEST(Modal, AcceptsTheModesThatClientsSend) {
  Modal modal;
  for (int tenths : {170, 200, 210, 400, 540, 610, 640, 800, 900, 910, 911, 940, 970, 980, 990})
    EXPECT_TRUE(modal.take(uint16_t(tenths))) << tenths;
}

TEST(Modal, LeavesMotionAndUnknownCodesAlone) {
  Modal modal;
  // Motion, what needs words, compensation, scaling, rotation, other systems, feed a turn.
  for (int tenths : {0,   10,  20,  30,  40,  100, 280, 300, 382, 410, 420, 430, 431, 490,
                     510, 520, 541, 591, 680, 730, 810, 840, 890, 920, 921, 950, 960, 1230})
    EXPECT_FALSE(modal.take(uint16_t(tenths))) << tenths;
  EXPECT_EQ(0, modal.motion);
}

TEST(Modal, EndOfProgramResetsPlaneAndOffsetsButKeepsUnits) {
  Modal modal;
  for (int tenths : {180, 200, 550, 910, 930}) modal.take(uint16_t(tenths));
  modal.motion = kPeck;
  modal.endProgram();
  EXPECT_EQ(17, modal.plane);
  EXPECT_EQ(0, modal.system);
  EXPECT_FALSE(modal.inverse_time);
  EXPECT_EQ(0, modal.motion);
  // Clients rely on units and G91 to stay.
  EXPECT_TRUE(modal.inches);
  EXPECT_TRUE(modal.relative);
  modal.motion = kNoMotion;
  modal.endProgram();
  EXPECT_EQ(0, modal.motion);
  modal.motion = 2;
  modal.endProgram();
  EXPECT_EQ(2, modal.motion);
}

TEST(WorkOffsets, FollowG10L20) {
  float stored[18] = {};
  WorkOffsets offsets(stored);
  offsets.setToolLength(-2);
  offsets.shiftTo(0, 2, 40, 0);
  EXPECT_FLOAT_EQ(40, offsets.at(0, 2));
  for (uint8_t axis = 0; axis < 3; ++axis) {
    stored[15 + axis] = offsets.storedFor(axis, 70, 12);
    EXPECT_FLOAT_EQ(70, offsets.at(5, axis) + 12) << int(axis);
  }
}

TEST(WorkOffsets, SetANewShiftAfterASuspendedOne) {
  const float stored[18] = {};
  WorkOffsets offsets(stored);
  offsets.shiftTo(0, 0, 10, 0);
  offsets.suspendShift();
  offsets.shiftTo(0, 1, 7, 0);
  EXPECT_FLOAT_EQ(7, offsets.at(0, 1));
}
