// Power may fail at any millisecond. When it comes back, the machine knows where it is or says that
// it does not.
#include <gtest/gtest.h>

#include <cmath>

#include "awakened.h"
#include "life.h"
#include "test_settings/published_image.h"

using namespace machine;

namespace {

const double kMostError = 0.3;  // [mm]

/// Watches while a dialogue plays, and checks at each millisecond what a power cut would leave.
class Onlooker {
 public:
  explicit Onlooker(Stage& stage) : stage_(stage) {
    stage.look = [this] { look(); };
  }

  int cuts = 0, known = 0, wrong = 0, z_compared = 0;
  std::string first_wrong;

 private:
  void look() {
    if (stage_.eeprom.writes != writes_ || cuts == 0) {
      writes_ = stage_.eeprom.writes;
      belief_ = awaken(stage_.eeprom.bytes);
    }
    ++cuts;
    if (!belief_.is_known) return;
    ++known;
    check(kLeftAxis, belief_.left, stage_.motor(kLeftAxis).travel);
    check(kRightAxis, belief_.right, stage_.motor(kRightAxis).travel);
    if (stage_.milliseconds_since_status() != 1 || stage_.status().empty()) return;
    // The stage knows no true height of z. Its encoder is sound, so the last report is true.
    const std::string place = stage_.status().substr(stage_.status().find("MPos:") + 5);
    float x, y, z;
    if (std::sscanf(place.c_str(), "%f,%f,%f", &x, &y, &z) != 3) return;
    ++z_compared;
    check(kZAxis, belief_.z, double(z));
  }

  void check(Axis axis, double believed, double travel) {
    const double truly = travel + stage_.motor(axis).coast();
    if (std::fabs(believed - truly) <= kMostError) return;
    if (wrong++ == 0)
      first_wrong = stage_.whereInTheScript() + ": axis " + std::to_string(axis) + " is at " +
                    std::to_string(truly) + ", believed " + std::to_string(believed);
  }

  Stage& stage_;
  Belief belief_ = {};
  long writes_ = -1;
};

/// Plays the dialogue of a stage and watches.
void expectNoFalsePlace(Stage& stage) {
  Onlooker onlooker(stage);
  try {
    live(stage);
  } catch (const Failure& failure) {
    FAIL() << failure.what();
  }
  std::printf("power cut %d times, %d starts with a position, %d of them wrong\n", onlooker.cuts,
              onlooker.known, onlooker.wrong);
  EXPECT_EQ(0, onlooker.wrong) << onlooker.first_wrong;
  EXPECT_GT(onlooker.known, 1000) << "a machine that never knows where it is would pass as well";
  EXPECT_GT(onlooker.z_compared, 5);
}

/// Plays the dialogue with every motion, with motors that coast for `coasting` [s].
void expectNoFalsePlace(double coasting) {
  Stage stage(readScript("test/dialogues", "power_cut_anywhere.nc"));
  for (const Axis axis : {kLeftAxis, kRightAxis, kZAxis}) stage.motor(axis).coasting = coasting;
  expectNoFalsePlace(stage);
}

}  // namespace

TEST(APowerCutAnywhere, LeavesNoFalsePosition) { expectNoFalsePlace(0.03); }

TEST(APowerCutAnywhere, LeavesNoFalsePositionWhereMotorsRunOn) { expectNoFalsePlace(0.4); }

TEST(APowerCutAnywhere, LeavesNoFalsePositionInTheFirstMoveAfterThePublishedFirmware) {
  // Nothing may move before the published data is retired, or the next start would take it over
  // again.
  Eeprom image = publishedImage(true);
  const uint32_t counts = 270000;
  storeLow(image, 310, counts, 4);
  storeLow(image, 314, counts, 4);
  Stage stage({{Step::kSkipTo, "ready", "ready"},
               {Step::kSend, "G91 G1 X30 F800", "move"},
               {Step::kAsk, "wait 12", "end"},
               {Step::kAsk, "answers from now", "end"}});
  for (uint16_t at = 0; at < 4096; ++at) stage.eeprom.bytes[at] = image.read(at);
  for (const Axis axis : {kLeftAxis, kRightAxis}) stage.motor(axis).travel = counts * 63.6 / 8148;
  expectNoFalsePlace(stage);
}
