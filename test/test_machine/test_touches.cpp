// Each row of the settings lists what it touches: these things change with its value, and nothing
// else does.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "../settings_host/eeprom.h"
#include "board_at_rest.h"
#include "machine/machine.h"
#include "settings_flash.h"

using namespace machine;
using settings::Entry;
using settings::Touch;
using settings::Values;

namespace {

using Signature = std::vector<float>;

/// Values of a machine on which every setting counts: a ring or two brackets, with all effects.
struct Machines {
  explicit Machines(float kinematics) : values(table, room) {
    for (uint8_t row = kFirstEffectSetting; row < kFirstPlaceSetting; ++row) {
      const Entry entry = table.at(row);
      values.setRow(row, 0.49f * entry.low + 0.51f * entry.high);
    }
    values.setRow(kKinematics, kinematics);
    for (const auto& [row, value] : {std::pair<Setting, float>{kRotationRadius, 139},
                                     {kChainWeight, 0.001f},
                                     {kSagCorrection, 5},
                                     {kZPositionP, 1300},
                                     {kMainPositionI, 20},
                                     {kMainSpeedI, 20},
                                     {kZPositionI, 20},
                                     {kZSpeedI, 20}})
      values.setRow(row, value);
  }

  FlashTable table;
  float room[kSettingCount];
  Values values;
};

/// Other values that a row may hold.
std::vector<float> others(const Entry& entry, float value) {
  std::vector<float> asked = {value * 1.3f, value * 0.5f, value + 0.2f * (entry.high - value)};
  if (entry.kind != settings::Kind::kReal) asked.insert(asked.end(), {entry.low, entry.high});
  std::vector<float> result;
  for (const float other : asked)
    if (other != value && settings::judge(entry, other) == settings::Refusal::kNone)
      result.push_back(other);
  return result;
}

/// Whether a signature changes with the value of a row, on any machine.
bool changes(uint8_t row, const std::function<Signature(const Values&)>& signature) {
  for (const float kinematics : {1.0f, 2.0f}) {
    const Machines usual(kinematics);
    const Signature before = signature(usual.values);
    const Entry entry = usual.table.at(row);
    for (const float value : others(entry, usual.values.at(row))) {
      Machines changed(kinematics);
      changed.values.setRow(row, value);
      if (signature(changed.values) != before) return true;
    }
  }
  return false;
}

void expectExactly(int touches, const std::function<Signature(const Values&)>& signature) {
  const FlashTable table;
  for (uint8_t row = 0; row < table.count(); ++row) {
    const Entry entry = table.at(row);
    EXPECT_EQ((entry.touches & touches) != 0, changes(row, signature)) << "$" << int(entry.number);
  }
}

/// Chain lengths and reach at many places, and where the sheet ends.
Signature whereItHangs(const Values& values) {
  Geometry geometry;
  geometry.prepare(values);
  Signature result = {geometry.sheet().low.x, geometry.sheet().high.y};
  for (float x = -1150; x < 1200; x += 460)
    for (float y = -560; y < 600; y += 280) {
      const motion::Lengths<float> lengths = geometry.inverse({x, y});
      result.push_back(lengths.reachable);
      if (lengths.reachable) result.insert(result.end(), {lengths.left, lengths.right});
    }
  return result;
}

/// Lengths of the axes on given counts.
Signature howLong(const Values& values) {
  BoardAtRest board;
  Axes axes(board, board);
  axes.prepare(values);
  axes.setCounts(100000, 200000, 300000);
  return {axes.length(kLeftAxis), axes.length(kRightAxis), axes.length(kZAxis)};
}

/// Duties while set-points jump and encoders turn unsteadily, and when an axis is left behind.
Signature howDriven(const Values& values) {
  BoardAtRest board;
  Axes axes(board, board);
  axes.prepare(values);
  axes.follow();
  Signature result;
  for (int tick = 0; tick < 200; ++tick) {
    for (uint8_t i = 0; i < kAxisCount; ++i) {
      if (tick % 50 == 0) axes.jumpTo(Axis(i), axes.length(Axis(i)) + 0.02f * float(1 + tick % 3));
      board.counted[i] = uint16_t(board.counted[i] + (tick * 7 + i) % 3 - 1);
    }
    axes.tick();
    result.insert(result.end(), board.duty.begin(), board.duty.end());
  }
  for (float behind = 0.01f; behind < 20; behind *= 1.2f) {
    for (uint8_t i = 0; i < kAxisCount; ++i) axes.jumpTo(Axis(i), axes.length(Axis(i)) + behind);
    axes.tick();
    result.push_back(float(axes.fault().fault));
  }
  return result;
}

/// Set-points of a corner, a dive and a crawl on the same chains.
Signature howItMoves(const Values& values) {
  const Machines usual(2);
  BoardAtRest board;
  Axes axes(board, board);
  axes.simulate(true);
  axes.prepare(usual.values);
  Geometry geometry;
  geometry.prepare(usual.values);
  Planner planner;
  planner.setGeometry(geometry);
  planner.boost(1.5f, 1);
  planner.prepare(values, axes.secondsPerTick());
  const motion::Lengths<float> from = geometry.inverse({0, 0});
  axes.declare(kLeftAxis, from.left);
  axes.declare(kRightAxis, from.right);
  planner.standAt(axes.setPoint());
  const motion::Point<float> places[] = {{0, 0}, {0, 30}, {6, 30}, {6, 36}};
  for (int i = 1; i < 4; ++i)
    planner.add(motion::line(places[i - 1], places[i]), i == 2 ? 1.0f : 0.0f, 14,
                motion::Space::kSheet);
  Signature result;
  while (!planner.isIdle() || !axes.isEmpty()) {
    planner.fill(axes, geometry);
    axes.tick();
    result.push_back(float(axes.setPoint().left));
    result.push_back(float(axes.setPoint().z));
  }
  return result;
}

/// Which pins are switched or pulsed as spindle and laser go on and off, whatever their strength.
Signature howItCuts(const Values& values) {
  BoardAtRest board;
  Cutter cutter(board, values);
  cutter.off();
  cutter.takeS(values.at(kSpindleMost));
  for (const bool on : {true, false}) {
    cutter.setSpindle(on);
    cutter.arm(true);
    cutter.show(on ? 255 : 0);
    board.switched.push_back(float(cutter.kind()));
  }
  return board.switched;
}

/// What a start with these settings asks of the drives, and its rate.
Signature howItStarts(const Values& values, bool asks_drives) {
  BoardAtRest board;
  settings_host::Eeprom eeprom;
  const FlashTable table;
  float room[kSettingCount];
  Values stored(table, room);
  settings::Memory memory(eeprom, stored);
  memory.start();
  for (uint8_t row = 0; row < table.count(); ++row) memory.setRow(row, values.at(row));
  settings_host::settle(memory);
  Machine machine({board, board, board, board, eeprom, table}, {2, "", machine::Start::kUsual});
  machine.begin();
  if (asks_drives) return board.arranged;
  return {float(machine.ticksPerSecond())};
}

}  // namespace

TEST(Touches, GeometryAffectsWhereTheSledHangs) {
  expectExactly(settings::kGeometry, whereItHangs);
}

TEST(Touches, ScaleAffectsTheLengthOfACount) { expectExactly(settings::kScale, howLong); }

TEST(Touches, ScaleAndLoopsAffectHowAxesAreDriven) {
  expectExactly(settings::kScale | settings::kLoops, howDriven);
}

TEST(Touches, LimitsAffectHowItMoves) { expectExactly(settings::kLimits, howItMoves); }

TEST(Touches, CutterAffectsTheCuttersPins) { expectExactly(settings::kCutter, howItCuts); }

TEST(Touches, DrivesAffectHowItStarts) {
  expectExactly(settings::kDrives, [](const Values& values) { return howItStarts(values, true); });
}

TEST(Touches, RestartAffectsTheTickRate) {
  expectExactly(settings::kRestart,
                [](const Values& values) { return howItStarts(values, false); });
}

TEST(Touches, ANewSettingOfTheDrivesActsAtOnce) {
  BoardAtRest board;
  settings_host::Eeprom eeprom;
  const FlashTable table;
  Machine machine({board, board, board, board, eeprom, table}, {2, "", machine::Start::kUsual});
  machine.begin();
  EXPECT_EQ(board.arranged, (Signature{1, 3}));
  board.input = "$38=2\n$39=1\n";
  for (int i = 0; i < 10; ++i) machine.loop();
  EXPECT_EQ(board.arranged, (Signature{0, 1}));
}
