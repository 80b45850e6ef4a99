// Power may fail at any millisecond. When it comes back, the machine knows where it is or says that
// it does not.
#include <gtest/gtest.h>

#include <cmath>

#include "awakened.h"
#include "host_machine.h"
#include "settings_host/published_image.h"

using namespace machine;

namespace {

const double kMostError = 0.3;  // [mm]

/// Watches while a dialogue plays, and checks at each millisecond what a power cut would leave.
class Onlooker {
 public:
  explicit Onlooker(HostMachine& machine) : machine_(machine) {
    machine.player.look = [this] { look(); };
  }

  int cuts = 0, known = 0, wrong = 0, z_compared = 0;
  std::string first_wrong;

 private:
  void look() {
    const SimulatedEeprom& memory = machine_.brain.memory();
    if (memory.writes != writes_ || cuts == 0) {
      writes_ = memory.writes;
      belief_ = awaken(memory.bytes);
    }
    ++cuts;
    if (!belief_.is_known) return;
    ++known;
    check(kLeftAxis, belief_.left, machine_.world.travelAtRest(world::kLeft));
    check(kRightAxis, belief_.right, machine_.world.travelAtRest(world::kRight));
    const std::string& status = machine_.player.status();
    if (machine_.player.millisecondsSinceStatus() != 0 || status.empty()) return;
    // The world knows no true zero of z. Its encoder is sound, so the last report is true.
    const std::string place = status.substr(status.find("MPos:") + 5);
    float x, y, z;
    if (std::sscanf(place.c_str(), "%f,%f,%f", &x, &y, &z) != 3) return;
    ++z_compared;
    const world::World& world = machine_.world;
    check(kZAxis, belief_.z, double(z) + world.travelAtRest(world::kZ) - world.travel(world::kZ));
  }

  void check(Axis axis, double believed, double truly) {
    if (std::fabs(believed - truly) <= kMostError) return;
    if (wrong++ == 0)
      first_wrong = machine_.player.whereInTheScript() + ": axis " + std::to_string(axis) +
                    " is at " + std::to_string(truly) + ", believed " + std::to_string(believed);
  }

  HostMachine& machine_;
  Belief belief_ = {};
  long writes_ = -1;
};

/// Plays the dialogue of a machine and watches.
void expectNoFalsePlace(HostMachine& machine) {
  Onlooker onlooker(machine);
  EXPECT_EQ("", machine.play());
  std::printf("power cut %d times, %d starts with a position, %d of them wrong\n", onlooker.cuts,
              onlooker.known, onlooker.wrong);
  EXPECT_EQ(0, onlooker.wrong) << onlooker.first_wrong;
  EXPECT_GT(onlooker.known, 1000) << "a machine that never knows where it is would pass as well";
  EXPECT_GT(onlooker.z_compared, 5);
}

}  // namespace

TEST(APowerCutAnywhere, LeavesNoFalsePosition) {
  HostMachine machine(readScript("test/dialogues", "power_cut_anywhere.nc"));
  expectNoFalsePlace(machine);
}

TEST(APowerCutAnywhere, LeavesNoFalsePositionInTheFirstMoveAfterAnUpgrade) {
  // Nothing may move before the published data is retired, or the next start would take it over
  // again.
  Eeprom image = publishedImage(true);
  const uint32_t counts = 270000;
  storeLow(image, 310, counts, 4);
  storeLow(image, 314, counts, 4);
  HostMachine machine({{Step::kSkipTo, "ready", "ready"},
                       {Step::kSend, "G91 G1 X30 F800", "move"},
                       {Step::kAsk, "wait 12", "end"},
                       {Step::kAsk, "answers from now", "end"}},
                      counts * 63.6 / 8148);
  machine.copyMemory(image);
  expectNoFalsePlace(machine);
}
