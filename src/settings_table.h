// Every $-number of the firmware but the effects': name, unit, default, limits, sentence.
// The effects' numbers come from their registry, lib/Kinematics/src/effects.h. Those of places that
// G-code keeps are in settings_places.h.
//
// It is a list of macro calls, because the board keeps the rows in flash and the host in plain
// memory (settings_flash.h; tools/core/plain_table.h). Each row:
//   name in C++, number, "name, unit", kind, step, default, lowest, highest, what it touches,
//   section and key of the published programs, or "", sentence,
//   what differs from the published firmware, or ""
// Once released, a number never changes its meaning. Free: 14, 47 to 59, 73, 74, 79 to 84.
// Never use 85 to 98 and 144: WebControl gives them another meaning.
#pragma once

#include <Kinematics.h>
#include <Settings.h>

#include "settings_places.h"

// clang-format off
#define PLUMB_PUBLISHED_SETTINGS(ROW) \
  ROW(kSheetWidth, 0, "sheet_width, mm", kReal, kAnyValue, 2438.4f, 200, 20000, kGeometry, \
      "Maslow: bedWidth", "Width of the sheet; the origin is its middle.", "") \
  ROW(kSheetHeight, 1, "sheet_height, mm", kReal, kAnyValue, 1219.2f, 100, 20000, kGeometry, \
      "Maslow: bedHeight", "Height of the sheet.", "") \
  ROW(kMotorGap, 2, "motor_gap, mm", kReal, kAnyValue, 2978.4f, 400, 20000, kGeometry, \
      "Maslow: motorSpacingX", "Distance between the sprocket centres.", "") \
  ROW(kMotorOffset, 3, "motor_offset, mm", kReal, kAnyValue, 463, 1, 20000, kGeometry, \
      "Maslow: motorOffsetY", "Sprocket centres above the sheet's top edge.", "") \
  ROW(kMountGap, 4, "mount_gap, mm", kReal, kAnyValue, 310, 1, 2000, kGeometry, \
      "Maslow: sledWidth", "Between the two brackets of a sled without ring.", "") \
  ROW(kMountHeight, 5, "mount_height, mm", kReal, kAnyValue, 139, -2000, 2000, kGeometry, \
      "Maslow: sledHeight", "Brackets above the bit.", "") \
  ROW(kCenterDepth, 6, "center_depth, mm", kReal, kAnyValue, 79, -2000, 2000, kGeometry, \
      "Maslow: sledCG", "Centre of gravity of that sled below the bit.", "") \
  ROW(kKinematics, 7, "kinematics", kByte, 1, 1, 1, 2, kGeometry, \
      "Computed: kinematicsTypeComputed", \
      "1: quadrilateral, a sled with two brackets; 2: triangular, a sled with a ring.", "") \
  ROW(kRotationRadius, 8, "rotation_radius, mm", kReal, kAnyValue, 250, 0, 2000, kGeometry, \
      "Advanced: rotationRadius", "From the bit to the end of each chain (triangular).", "") \
  ROW(kIdleTime, 9, "idle_time, ms", kWord, 1, 2000, 0, 65535, kNothing, \
      "", "Rest after which the motors are switched off and the position is kept.", "") \
  ROW(kChainLength, 10, "chain_length, mm", kWord, 1, 3360, 0, 65535, kGeometry, \
      "Advanced: chainLength", "Length of each chain; no more is paid out.", "") \
  ROW(kExtendLength, 11, "extend_length, mm", kWord, 1, 1651, 0, 65535, kNothing, \
      "Advanced: chainExtendLength", "Chain paid out for hooking on the sled.", "") \
  ROW(kEncoderCounts, 12, "encoder_counts, counts/turn", kReal, kAnyValue, 8113.73f, 1, 1e6f, kScale, \
      "Advanced: encoderSteps", "Encoder counts for one turn of a sprocket.", "") \
  ROW(kChainPerTurn, 13, "chain_per_turn, mm", kReal, kAnyValue, 63.5f, 1, 1000, kScale | kGeometry | kLimits, \
      "Computed: distPerRot", "Chain for one turn of a sprocket: teeth times pitch.", \
      "the published sprocket has a radius of 10.1 mm until this is written") \
  ROW(kGreatestFeed, 15, "greatest_feed, mm/min", kWord, 1, 900, 1, 65535, kLimits, \
      "Advanced: maxFeedrate", "Greatest feed, and that of G0.", "") \
  ROW(kZMotor, 16, "z_motor", kBool, 1, 1, 0, 1, kNothing, \
      "Maslow: zAxis", "1: the z axis has a motor; 0: it is set by hand.", "") \
  ROW(kSpindle, 17, "spindle", kByte, 1, 0, 0, 4, kCutter, \
      "Advanced: spindleAutomate", \
      "0: not switched; 1: servo; 2: relay, on when high; 3: relay, on when low; 4: pulsed by S.", "4 is new") \
  ROW(kZSpeed, 18, "z_speed, turns/min", kReal, kAnyValue, 12.6f, 0.01f, 1000, kLimits, \
      "", "Greatest speed of the z axis.", "") \
  ROW(kZPerTurn, 19, "z_per_turn, mm", kReal, kAnyButZero, 3.17f, -1000, 1000, kScale | kLimits, \
      "Maslow: zDistPerRot", "Travel of z for one turn; negative: it runs the other way.", "") \
  ROW(kZCounts, 20, "z_counts, counts/turn", kReal, kAnyButZero, 7560, -1e6f, 1e6f, kScale, \
      "Advanced: zEncoderSteps", \
      "Encoder counts for one turn of z; negative: motor or encoder is wired the other way.", "") \
  ROW(kMainPositionP, 21, "main_position_p", kReal, kAnyValue, 1300, 0, 1e6f, kLoops, \
      "Computed: KpPosMain", \
      "Position loop of the chain motors: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kMainPositionI, 22, "main_position_i", kReal, kAnyValue, 0, 0, 1e6f, kLoops, \
      "Computed: KiPosMain", \
      "Position loop of the chain motors: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kMainPositionD, 23, "main_position_d", kReal, kAnyValue, 34, 0, 1e6f, kLoops, \
      "Computed: KdPosMain", \
      "Position loop of the chain motors: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kMainPositionWeight, 24, "main_position_weight", kReal, kAnyValue, 1, 0, 1, kLoops, \
      "Computed: propWeightMain", \
      "Position loop of the chain motors: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kMainSpeedP, 25, "main_speed_p", kReal, kAnyValue, 5, 0, 1e6f, kLoops, \
      "Computed: KpVMain", "Speed loop of the chain motors: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kMainSpeedI, 26, "main_speed_i", kReal, kAnyValue, 0, 0, 1e6f, kLoops, \
      "Computed: KiVMain", "Speed loop of the chain motors: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kMainSpeedD, 27, "main_speed_d", kReal, kAnyValue, 0.28f, 0, 1e6f, kLoops, \
      "Computed: KdVMain", "Speed loop of the chain motors: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kMainSpeedWeight, 28, "main_speed_weight", kReal, kAnyValue, 1, 0, 1, kLoops, \
      "", "Speed loop of the chain motors: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kZPositionP, 29, "z_position_p", kReal, kAnyValue, 1300, 0, 1e6f, kLoops, \
      "Computed: KpPosZ", \
      "Position loop of z: P, I, D, and the share of P that acts on the error; z refuses to move while P is 0.", \
      "the published default is 0, and nothing watches z then") \
  ROW(kZPositionI, 30, "z_position_i", kReal, kAnyValue, 0, 0, 1e6f, kLoops, \
      "Computed: KiPosZ", \
      "Position loop of z: P, I, D, and the share of P that acts on the error; z refuses to move while P is 0.", "") \
  ROW(kZPositionD, 31, "z_position_d", kReal, kAnyValue, 34, 0, 1e6f, kLoops, \
      "Computed: KdPosZ", \
      "Position loop of z: P, I, D, and the share of P that acts on the error; z refuses to move while P is 0.", "") \
  ROW(kZPositionWeight, 32, "z_position_weight", kReal, kAnyValue, 1, 0, 1, kLoops, \
      "Computed: propWeightZ", \
      "Position loop of z: P, I, D, and the share of P that acts on the error; z refuses to move while P is 0.", "") \
  ROW(kZSpeedP, 33, "z_speed_p", kReal, kAnyValue, 5, 0, 1e6f, kLoops, \
      "Computed: KpVZ", "Speed loop of z: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kZSpeedI, 34, "z_speed_i", kReal, kAnyValue, 0, 0, 1e6f, kLoops, \
      "Computed: KiVZ", "Speed loop of z: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kZSpeedD, 35, "z_speed_d", kReal, kAnyValue, 0.28f, 0, 1e6f, kLoops, \
      "Computed: KdVZ", "Speed loop of z: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kZSpeedWeight, 36, "z_speed_weight", kReal, kAnyValue, 1, 0, 1, kLoops, \
      "", "Speed loop of z: P, I, D, and the share of P that acts on the error.", "") \
  ROW(kSagCorrection, 37, "sag_correction, 1e-12/mm^2", kReal, kAnyValue, 0, -1e5f, 1e5f, kGeometry, \
      "Advanced: chainSagCorrection", "Chain sag as the published programs fit it; added to $160.", \
      "the chains are as published to within 0.3 % of the sag") \
  ROW(kFeedSide, 38, "feed", kByte, 1, 1, 1, 2, kGeometry | kDrives, \
      "Computed: chainOverSprocketComputed", "1: chains leave over the top of their sprockets; 2: off the bottom.", \
      "") \
  ROW(kPwmFrequency, 39, "pwm_frequency", kByte, 1, 3, 1, 3, kDrives, \
      "Computed: fPWMComputed", "Motor PWM: 1 is 31 kHz, 2 is 4 kHz, 3 is 490 Hz, as far as the driver allows.", "") \
  ROW(kLeftTolerance, 40, "left_tolerance, %", kReal, kAnyValue, 0, -5, 5, kGeometry, \
      "Advanced: leftChainTolerance", "How much longer than nominal the left chain's links are; added to $180.", \
      "$180 does not stretch the ring") \
  ROW(kRightTolerance, 41, "right_tolerance, %", kReal, kAnyValue, 0, -5, 5, kGeometry, \
      "Advanced: rightChainTolerance", "The same for the right chain; added to $181.", "") \
  ROW(kPositionErrorLimit, 42, "position_limit, mm", kReal, kAnyValue, 2, 0.01f, 100000, kLoops, \
      "Advanced: positionErrorLimit", "A chain this far from where it should be stops the machine.", "")

#define PLUMB_HIDDEN_SETTINGS(ROW) \
  ROW(kZUpperLimit, 43, "z_upper_limit, mm", kReal, kAnyValue, 10000, -10000, 10000, kNothing, \
      "", "Highest z, set by B17; 10000: none.", "writing to it is refused; none is 10000, not a NaN") \
  ROW(kZLowerLimit, 44, "z_lower_limit, mm", kReal, kAnyValue, -10000, -10000, 10000, kNothing, \
      "", "Lowest z, set by B18; -10000: none.", "writing to it is refused; none is -10000, not a NaN")

#define PLUMB_ADDED_SETTINGS(ROW) \
  ROW(kSpindleLeast, 60, "spindle_least, turns/min", kReal, kAnyValue, 4000, 0, 100000, kNothing, \
      "", "Slowest speed of a pulsed spindle ($17 = 4); S below it counts as this.", "new") \
  ROW(kSpindleMost, 61, "spindle_most, turns/min", kReal, kAnyValue, 24000, 1, 100000, kNothing, \
      "", "Speed of a pulsed spindle whose pin is always high.", "new") \
  ROW(kSledWeight, 62, "sled_weight, N", kReal, kAnyValue, 97.9f, 30, 1000, kGeometry, \
      "", "Sled, router and bricks, as far as the chains carry them; $46=... of WebControl sets it too.", "new") \
  ROW(kChainWeight, 63, "chain_weight, N/mm", kReal, kAnyValue, 0, 0, 0.02f, kGeometry, \
      "", \
      "A millimetre of chain, 0.00137293 for the usual chain; 0: the sled alone loads the chains, as in the " \
      "published model.", "new") \
  ROW(kMotorCenterX, 64, "motor_center_x, mm", kReal, kAnyValue, 0, -5000, 5000, kGeometry, \
      "", "Middle between the sprockets, right of the middle of the sheet.", "new") \
  ROW(kAccelerationXy, 65, "acceleration_xy, mm/s^2", kReal, kAnyValue, 100, 1, 5000, kLimits, \
      "", "Greatest acceleration along the sheet.", "new") \
  ROW(kAccelerationZ, 66, "acceleration_z, mm/s^2", kReal, kAnyValue, 10, 0.1f, 5000, kLimits, \
      "", "Greatest acceleration of z.", "new") \
  ROW(kCornerDeviation, 67, "corner_deviation, mm", kReal, kAnyValue, 0.05f, 0, 10, kLimits, \
      "", "How far from a corner the sled may pass without stopping; 0: it stops.", "new") \
  ROW(kChainSpeed, 68, "chain_speed, mm/min", kReal, kAnyValue, 1000, 10, 10000, kLimits, \
      "", \
      "Greatest speed of a chain; moves are slowed to keep it. More than 20 sprocket turns a minute (1270 with " \
      "$13=63.5) is refused.", "new") \
  ROW(kLoopRate, 69, "loop_rate, Hz", kByte, 100, 100, 100, 200, kRestart, \
      "", "How often the motors are controlled: 100 or 200.", "new") \
  ROW(kRefusedMotion, 70, "refused_motion", kBool, 1, 0, 0, 1, kNothing, \
      "", \
      "A line whose motion cannot be done: 0 halts the machine until Stop; 1 answers error: and goes on with " \
      "the next.", "new") \
  ROW(kMotionAhead, 71, "motion_ahead, ms", kWord, 1, 1000, 0, 10000, kNothing, \
      "", \
      "A line is answered when less than this is left of its motion, so that a sender that stops stops the sled.", \
      "new") \
  ROW(kLaserPulses, 72, "laser_pulses", kBool, 1, 0, 0, 1, kCutter, \
      "", "0: the laser's pin is high or low; 1: it is pulsed by S (0 to 255) and speed.", "new") \
  ROW(kBandGap, 75, "band_gap, V", kReal, kAnyValue, 1.1f, 0.9f, 1.3f, kNothing, \
      "", "Reference of this processor; right when B30 shows the supply that a voltmeter shows on the 5 V pin.", \
      "new") \
  ROW(kLeastSupply, 76, "least_supply, V", kReal, kAnyValue, 4.3f, 0, 5, kNothing, \
      "", "The machine says so when the Mega's supply falls below this; 0: never.", "new") \
  ROW(kHoldingTorque, 77, "holding_torque, N m", kReal, kAnyValue, 1.4f, 0, 1000, kNothing, \
      "", \
      "What friction holds at the sprocket of a motor without power. Where the sled pulls harder, the motors stay " \
      "on at rest; 10: they never do.", "new") \
  ROW(kReportInches, 78, "report_inches", kBool, 1, 0, 0, 1, kNothing, \
      "", "Units of the status for a sender of Grbl (its $13). 0: mm; 1: inches.", "new")

#define PLUMB_KEPT_SETTINGS(ROW) \
  ROW(kSimulatedMotors, 99, "simulated_motors", kBool, 1, 0, 0, 1, kNothing, \
      "", "1: the machine runs without motors, as B99 ON asks; kept by all but $RST=*.", \
      "the published firmware keeps it at address 4095")

#define PLUMB_SETTINGS(LISTED, HIDDEN, KEPT) \
  PLUMB_PUBLISHED_SETTINGS(LISTED) \
  PLUMB_HIDDEN_SETTINGS(HIDDEN) \
  PLUMB_ADDED_SETTINGS(LISTED) \
  PLUMB_KEPT_SETTINGS(KEPT)
// clang-format on

// The rows as values of settings::Entry, where the names of that namespace are in use.
#define PLUMB_ENTRY(access, name, number, label, kind, step, usual, low, high, touches, ...) \
  {number, Kind::kind, Access::access, step, touches, usual, low, high},
#define PLUMB_LISTED(...) PLUMB_ENTRY(kListed, __VA_ARGS__)
#define PLUMB_HIDDEN(...) PLUMB_ENTRY(kHidden, __VA_ARGS__)
#define PLUMB_KEPT(...) PLUMB_ENTRY(kKept, __VA_ARGS__)
#define PLUMB_ENTRIES PLUMB_SETTINGS(PLUMB_LISTED, PLUMB_HIDDEN, PLUMB_KEPT)

// Texts for refusing $n=v; see Word in lib/Settings/src/table.h.
// clang-format off
#define PLUMB_SETTINGS_WORDS(WORD) \
  WORD(kUnknown, "is no setting") \
  WORD(kHidden, "is set by B codes only (Z limits: B17, B18, B19)") \
  WORD(kNoNumber, "needs a number") \
  WORD(kZero, "must not be zero") \
  WORD(kFrom, "must be from ") \
  WORD(kTo, " to ") \
  WORD(kWhole, ", a whole number") \
  WORD(kSteps, ", in steps of ")
// clang-format on

/// The rows by name; the effects' parameters follow in the registry's order, and then the places.
#define PLUMB_NAME(name, ...) name,
enum Setting : uint8_t {
  PLUMB_SETTINGS(PLUMB_NAME, PLUMB_NAME, PLUMB_NAME) kFirstEffectSetting,
  kFirstPlaceSetting = kFirstEffectSetting + kinematics::kEffectParamCount,
  kSettingCount = kFirstPlaceSetting + kPlaceCount
};
#undef PLUMB_NAME

// Two copies and the ring of positions must fit, and 255 means "none".
static_assert(10 + 5 * kSettingCount <= settings::Memory::kCopyRoom, "a copy has no room");
static_assert(kSettingCount < settings::kNoIndex, "too many settings");

/// The number that a client means: WebControl's sled weight is our $-number for it, and each effect
/// names its client's number.
inline uint8_t meantBy(uint8_t number) {
  return number == 46 ? 62 : kinematics::Effects::For<float>::meantBy(number);
}
