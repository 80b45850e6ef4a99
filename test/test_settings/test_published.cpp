// Moving from the published firmware: its settings and counts are taken over whole or not at all.
// Afterwards it never takes our data, nor its old data, as valid.
#include <cmath>

#include "../settings_host/published_image.h"
#include "boards.h"

namespace {

void expectImported(Board& board, bool z_limits) {
  for (const InBlock& each : kBlock)
    EXPECT_EQ(each.value, board.values.at(indexOf(board.table, each.number))) << int(each.number);
  EXPECT_EQ(z_limits ? 10.5f : 10000.0f, board.values.at(kZUpperLimit));
  EXPECT_EQ(z_limits ? -20.25f : -10000.0f, board.values.at(kZLowerLimit));
}

void expectCounts(const Board& board) {
  const Counts counts;
  EXPECT_EQ(Known::kAtRest, board.started.known);
  EXPECT_EQ(counts.left, board.started.position.left);
  EXPECT_EQ(counts.right, board.started.position.right);
  EXPECT_EQ(counts.z, board.started.position.z);
  EXPECT_EQ(board.memory.scale(), board.started.position.scale);
}

void expectDefaults(const Board& board) {
  for (uint8_t i = 0; i < kSettingCount; ++i)
    EXPECT_EQ(board.table.at(i).usual, board.values.at(i)) << i;
}

}  // namespace

TEST(Published, BothLayoutsOfVersionFiveAreImportedWithTheirCounts) {
  for (bool z_limits : {false, true}) {
    Eeprom eeprom = publishedImage(z_limits);
    {
      Board board(eeprom);
      EXPECT_EQ(Source::kImported, board.started.source);
      expectImported(board, z_limits);
      expectCounts(board);
      EXPECT_FALSE(board.started.position.has_place);
      settle(board.memory);
    }
    Board after(eeprom);
    EXPECT_EQ(Source::kStored, after.started.source);
    expectImported(after, z_limits);
    expectCounts(after);
  }
}

TEST(Published, IsInvalidatedSoThatOldDataNeverComesBack) {
  for (bool z_limits : {false, true}) {
    Eeprom eeprom = publishedImage(z_limits);
    Board board(eeprom);
    board.memory.beginMoving();
    EXPECT_FALSE(board.memory.mayMove()) << "its counts are still valid";
    while (!board.memory.mayMove()) board.memory.step();
    EXPECT_FALSE(publishedFindsSettings(eeprom));
    EXPECT_FALSE(publishedFindsPosition(eeprom));
  }
}

TEST(Published, EveryCutDuringTheImportLeavesOneSideWhole) {
  int cuts = 0;
  for (bool z_limits : {false, true})
    cuts += cutEverywhere(
        publishedImage(z_limits), [](Board&) {},
        [&](Board& board, int) {
          expectImported(board, z_limits);
          expectCounts(board);
        },
        1);
  std::printf("import: power cut %d times\n", cuts);
  EXPECT_GT(cuts, 4000);
}

TEST(Published, CountsAreInvalidOnceWeHaveMoved) {
  // A cut at any write of start, motion and rest: its old counts never count as "at rest" there.
  const Position there = positionOf(5);
  const int cuts = cutEverywhere(
      publishedImage(true),
      [&](Board& board) {
        board.memory.beginMoving();
        while (!board.memory.mayMove()) board.memory.step();
        board.memory.keepPosition(there);
      },
      [&](Board& board, int) {
        if (board.started.known != Known::kAtRest) return;
        const bool is_there = same(there, board.started.position);
        ASSERT_TRUE(is_there || board.started.position.left == Counts().left);
      },
      1);
  EXPECT_GT(cuts, 1000);
  Eeprom eeprom = publishedImage(true);
  {
    Board board(eeprom);
    board.memory.beginMoving();
    while (!board.memory.mayMove()) board.memory.step();
  }
  EXPECT_EQ(Known::kMoving, Board(eeprom).started.known) << "power lost in the first motion";
}

TEST(Published, IsImportedAgainAfterItWasUsedAgain) {
  Eeprom eeprom = publishedImage(true);
  {
    Board board(eeprom);
    settle(board.memory);
    board.memory.set(62, 120);
    board.memory.set(2, 2999);
    board.memory.keepPosition(positionOf(7));
    settle(board.memory);
  }
  EXPECT_FALSE(publishedFindsSettings(eeprom));
  // The published firmware writes its version, markers, block and counts.
  Eeprom its = publishedImage(true);
  for (uint16_t address = 300; address <= 494; ++address) eeprom[address] = its[address];
  Board board(eeprom);
  EXPECT_EQ(Source::kImported, board.started.source);
  expectImported(board, true);
  expectCounts(board);
  EXPECT_EQ(120, board.values.at(kSledWeight)) << "our settings stay";
}

TEST(Published, SettingsWithoutCountsMakeOurPositionDoubtful) {
  Eeprom eeprom = publishedImage(true);
  {
    Board board(eeprom);
    settle(board.memory);
  }
  Eeprom its = publishedImage(true, false);
  for (uint16_t address = 300; address <= 494; ++address) eeprom[address] = its[address];
  {
    Board board(eeprom);
    EXPECT_EQ(Known::kMoving, board.started.known);
    settle(board.memory);
  }
  EXPECT_EQ(Known::kMoving, Board(eeprom).started.known);
}

TEST(Published, ErasedSettingsKeepTheirCounts) {
  Eeprom eeprom = publishedImage(true);
  for (uint16_t address = 340; address <= 494; ++address) eeprom[address] = 0;
  Board board(eeprom);
  EXPECT_EQ(Source::kDefaults, board.started.source);
  expectDefaults(board);
  expectCounts(board);
}

TEST(Published, OtherVersionsAreRefusedAndNamed) {
  for (int version : {1, 2, 3, 4, 6, 57}) {
    Eeprom eeprom = publishedImage(true);
    eeprom[300] = uint8_t(version);
    for (uint16_t marker : {502, 514}) eeprom[marker] = 56;
    Board board(eeprom);
    EXPECT_EQ(Source::kOtherVersion, board.started.source);
    EXPECT_EQ(Known::kNothing, board.started.known);
    expectDefaults(board);
    EXPECT_EQ(version, board.started.version);
    // The data stays for that firmware until the first setting or motion.
    settle(board.memory);
    EXPECT_EQ(version, eeprom[300]);
    board.memory.set(2, 3000);
    settle(board.memory);
    EXPECT_EQ(0xFF, eeprom[300]);
    EXPECT_FALSE(publishedFindsPosition(eeprom));
  }
}

TEST(Published, OtherVersionsMakeOurPositionDoubtful) {
  Eeprom eeprom;
  {
    Board board(eeprom);
    board.memory.set(2, 3000);
    board.memory.keepPosition(positionOf(1));
    settle(board.memory);
  }
  eeprom[300] = 6;
  eeprom[301] = 56;
  Board board(eeprom);
  EXPECT_EQ(Source::kOtherVersion, board.started.source);
  EXPECT_EQ(3000, board.values.at(kMotorGap)) << "our settings are still ours";
  EXPECT_EQ(Known::kMoving, board.started.known);
}

TEST(Published, PositionsBeforeVersionOneAreRefused) {
  Eeprom eeprom;
  for (uint16_t marker : {5, 105, 205}) eeprom[marker] = 56;
  Board board(eeprom);
  EXPECT_EQ(Source::kOtherVersion, board.started.source);
  EXPECT_EQ(0, board.started.version);
  EXPECT_EQ(Known::kNothing, board.started.known);
}

TEST(Published, WithAnImpossibleValueIsNotImported) {
  for (auto [number, value] :
       {std::pair<int, float>{8, NAN}, {2, -5}, {13, 0}, {21, -1}, {12, INFINITY}}) {
    Eeprom eeprom = publishedImage(true);
    for (const InBlock& each : kBlock)
      if (each.number == number) storeSetting(eeprom, each, value);
    Board board(eeprom);
    EXPECT_EQ(Source::kBadValue, board.started.source);
    EXPECT_EQ(number, board.started.number);
    EXPECT_EQ(Known::kNothing, board.started.known);
    expectDefaults(board);
  }
}

TEST(Published, UncheckedValuesAreReadAsItUsedThem) {
  Eeprom eeprom = publishedImage(true);
  for (const InBlock& each : kBlock) {
    if (each.number == 7 || each.number == 38) storeSetting(eeprom, each, 0);
    if (each.number == 16) storeSetting(eeprom, each, 255);
    if (each.number == 17) storeSetting(eeprom, each, 700);
  }
  for (const InBlock& each : kZLimits) storeSetting(eeprom, each, NAN);
  Board board(eeprom);
  EXPECT_EQ(Source::kImported, board.started.source);
  EXPECT_EQ(2, board.values.at(kKinematics));
  EXPECT_EQ(2, board.values.at(kFeedSide));
  EXPECT_EQ(1, board.values.at(kZMotor));
  EXPECT_EQ(0, board.values.at(kSpindle));
  EXPECT_EQ(10000, board.values.at(kZUpperLimit));
  EXPECT_EQ(-10000, board.values.at(kZLowerLimit));
}

TEST(Published, IsNeverFoundInOurData) {
  std::mt19937 random(41);
  Eeprom eeprom;
  Board board(eeprom);
  for (int i = 0; i < 2000; ++i) {
    const uint8_t index = uint8_t(random() % kSettingCount);
    const Entry entry = board.table.at(index);
    const float share = float(random()) / float(random.max());
    board.memory.setRow(index, entry.low + share * (entry.high - entry.low));
    board.memory.keepPosition(positionOf(int(random() & 0xFFFF)));
    settle(board.memory);
  }
  for (uint16_t address = 0; address < 544; ++address) ASSERT_EQ(0xFF, eeprom[address]);
  EXPECT_EQ(0xFF, eeprom[4095]) << "its switch for simulated motors";
}

TEST(Published, NoiseGivesDefaults) {
  std::mt19937 random(42);
  int defaults = 0;
  for (int run = 0; run < 500; ++run) {
    Eeprom eeprom;
    for (uint16_t address = 0; address < 4096; ++address) eeprom[address] = uint8_t(random());
    Board board(eeprom);
    EXPECT_EQ(Known::kNothing, board.started.known);
    expectDefaults(board);
    if (board.started.source != Source::kDefaults) continue;
    ++defaults;
  }
  EXPECT_GT(defaults, 490);
}
