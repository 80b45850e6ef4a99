// Modes and the beginnings of coordinates.
#include <gtest/gtest.h>

#include "reading.h"

using namespace gcode;

TEST(Modal, TakesTheModesThatClientsSendFreely) {
  Modal modal;
  for (int tenths : {170, 200, 210, 400, 540, 610, 640, 800, 900, 910, 911, 940, 970, 980, 990})
    EXPECT_TRUE(modal.take(uint16_t(tenths))) << tenths;
}

TEST(Modal, LeavesWhatMovesAndWhatItCannotKeep) {
  Modal modal;
  // Motion, what needs words, compensation, scaling, rotation, other systems, feed a turn.
  for (int tenths : {0,   10,  20,  30,  40,  100, 280, 300, 382, 410, 420, 430, 431, 490,
                     510, 520, 541, 591, 680, 730, 810, 840, 890, 920, 921, 950, 960, 1230})
    EXPECT_FALSE(modal.take(uint16_t(tenths))) << tenths;
  EXPECT_EQ(0, modal.motion);
}

TEST(Modal, RemembersPlaneSystemAndWayBack) {
  Modal modal;
  EXPECT_EQ(17, modal.plane);
  modal.take(190);
  EXPECT_EQ(19, modal.plane);
  modal.take(590);
  EXPECT_EQ(5, modal.system);
  modal.take(540);
  EXPECT_EQ(0, modal.system);
  modal.take(990);
  EXPECT_TRUE(modal.retracts_to_r);
  modal.take(980);
  EXPECT_FALSE(modal.retracts_to_r);
  modal.take(901);
  EXPECT_TRUE(modal.absolute_centres);
  modal.take(911);
  EXPECT_FALSE(modal.absolute_centres);
}

TEST(Modal, EndsAProgramInTheCoordinatesThatClientsKnow) {
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

TEST(Modal, ForgetsATimeAtTheEndOfItsLine) {
  Modal modal;
  modal.take(930);
  EXPECT_TRUE(modal.inverse_time);
  modal.inverse_feed = 5;
  modal.beginLine();
  EXPECT_EQ(0, modal.inverse_feed);
  EXPECT_TRUE(modal.inverse_time);
  modal.take(940);
  EXPECT_FALSE(modal.inverse_time);
}

TEST(Modal, CountsFromTheMachinesZeroForOneLine) {
  Modal modal;
  modal.take(910);
  modal.take(530);
  EXPECT_FLOAT_EQ(7, modal.targetOf(100, 7, 30));
  modal.beginLine();
  EXPECT_FLOAT_EQ(107, modal.targetOf(100, 7, 30));
  modal.take(900);
  EXPECT_FLOAT_EQ(37, modal.targetOf(100, 7, 30));
}

TEST(WorkOffsets, AddSystemShiftAndTool) {
  float stored[18] = {1, 2, 3, 10, 20, 30};
  WorkOffsets offsets(stored);
  EXPECT_FLOAT_EQ(2, offsets.at(0, 1));
  EXPECT_FLOAT_EQ(30, offsets.at(1, 2));
  offsets.setToolLength(0.5f);
  EXPECT_FLOAT_EQ(30.5f, offsets.at(1, 2));
  EXPECT_FLOAT_EQ(20, offsets.at(1, 1));
  // G92 X5 where the machine stands at 100 in the second system.
  offsets.shiftTo(1, 0, 100, 5);
  EXPECT_FLOAT_EQ(95, offsets.at(1, 0));
  EXPECT_FLOAT_EQ(86, offsets.at(0, 0)) << "all systems move along";
  offsets.suspendShift();
  EXPECT_FLOAT_EQ(10, offsets.at(1, 0));
  offsets.resumeShift();
  EXPECT_FLOAT_EQ(95, offsets.at(1, 0));
  offsets.clearShift();
  EXPECT_FLOAT_EQ(10, offsets.at(1, 0));
}

TEST(WorkOffsets, CallAPlaceWhatG10L20Says) {
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

TEST(WorkOffsets, TakeANewShiftAfterASuspendedOne) {
  const float stored[18] = {};
  WorkOffsets offsets(stored);
  offsets.shiftTo(0, 0, 10, 0);
  offsets.suspendShift();
  offsets.shiftTo(0, 1, 7, 0);
  EXPECT_FLOAT_EQ(7, offsets.at(0, 1));
}
