// The simulated board's time, serial line, motors and faults.
#include "world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "answers.h"
#include "must.h"

using namespace machine;

namespace {

const double kBytesPerMs = 5.88;  // 58,824 baud, ten bits each
const int kOutRoom = 255, kInRoom = 255, kClientRoom = 126;
const long kLongestGapMs = 1500;     // clients give up after 2 s of silence
const long kStoryMs = 30000;         // then Stop is pressed in any case
const long kPatienceMs = 6000;       // that a polite sender waits for an answer
const long kLastPatienceMs = 60000;  // for the settings after a stop
const long kQuietMs = 3000;

const char* const kStopAndAsk = "!\n$$\n";
const char* const kResetAndAsk = "\x18\n$$\n";  // as a Grbl sender

const double kMainPerCount = 63.5 / 8113.73, kZPerCount = 3.17 / 7560;  // [mm]
const double kMainTopSpeed = 26, kZTopSpeed = 1.1;                      // [mm/s]

class World : public Wire, public Drives, public Aux, public Clock {
 public:
  explicit World(const Story& story)
      : story_(story),
        motor_{{kMainPerCount, kMainTopSpeed},
               {kMainPerCount, kMainTopSpeed},
               {kZPerCount, kZTopSpeed}} {
    if (!story.eeprom.empty()) eeprom.bytes = story.eeprom;
  }

  /// From power-on to a power cut or the end.
  void liveOnce() {
    const FlashTable table;
    Machine machine({*this, *this, *this, *this, eeprom, table}, {2, "", machine::Start::kUsual});
    machine_ = &machine;
    is_greeting_ = true;
    answers_ = ::Answers();
    machine.begin();
    is_greeting_ = false;
    for (;;) {
      machine.loop();
      answers_.wentRound();
      checkRest();
    }
  }

  void restart() {
    machine_ = nullptr;
    for (SimulatedMotor& motor : motor_) motor.restartCount();
    for (uint8_t axis = 0; axis < kAxisCount; ++axis) release(Axis(axis));
    wire_.clear();
    partial_.clear();
    out_queue_ = 0;
    last_line_ms_ = now_ms_;
  }

  int16_t read() override {
    if (wire_.empty()) return -1;
    const char character = wire_.front();
    wire_.erase(0, 1);
    answers_.taken(character);
    return uint8_t(character);
  }

  void write(char character) override {
    while (out_queue_ >= kOutRoom) pass(1);
    ++out_queue_;
    if (character != '\n') {
      must(character == '\r' || (character >= 32 && character < 127),
           "a character that is no text");
      partial_ += character;
      return;
    }
    must(!partial_.empty() && partial_.back() == '\r', "a line without CR: " + partial_);
    partial_.pop_back();
    last_line_ms_ = now_ms_;
    if (!is_greeting_ || (partial_ != "ok" && partial_.compare(0, 6, "error:") != 0))
      answers_.said(partial_);
    if (!answers_.mayDrive())
      for (const SimulatedMotor& motor : motor_) must(!motor.powered, "an alarm leaves a motor on");
    partial_.clear();
  }

  uint8_t lost() override { return uint8_t(std::exchange(lost_, 0)); }

  void drive(Axis axis, int16_t duty) override {
    must(duty >= -255 && duty <= 255, "a duty beyond 255");
    must(duty == 0 || answers_.mayDrive(), "a motor is driven after an alarm");
    must(duty == 0 || !answers_.isSimulated(), "a motor is driven though all are simulated");
    motor_[axis].duty = duty;
    motor_[axis].powered = true;
  }

  void release(Axis axis) override {
    motor_[axis].duty = 0;
    motor_[axis].powered = false;
  }

  void brake(Axis axis) override { release(axis); }

  uint16_t count(Axis axis) override { return motor_[axis].count(); }
  uint16_t illegalSteps(Axis) override { return 0; }
  void arrange(bool, uint8_t) override {}
  void set(Output, bool) override {}
  void pulse(Output, uint8_t) override {}
  void turnServo(uint8_t) override {}
  bool probeTouches() override { return touches_; }
  uint32_t milliseconds() override { return uint32_t(now_ms_); }
  void holdTicks() override {}
  void releaseTicks() override {}

  void idle() override {
    if (answers_.isUnclear()) throw TheEnd();
    pass(story_.step_ms);
    must(answers_.isOfGrbl() || now_ms_ - last_line_ms_ <= kLongestGapMs + story_.step_ms,
         "silence for over 1.5 s");
    if (!is_ending_ && isTold()) end();
    if (is_ending_) lookForEnd();
  }

  SimulatedEeprom eeprom;

 private:
  /// Between two lines of the program, at rest, the next move begins at the height where z is. From
  /// a height beyond all travel, which an EEPROM may claim, no move begins, nor before a stop ends.
  void checkRest() const {
    const float kHair = 0.01f;  // [mm]
    const Axes& axes = machine_->parts().axes;
    const float z = machine_->parts().program.aim().z;
    if (!answers_.isIdle() || !machine_->parts().planner.isIdle() || !axes.isEmpty()) return;
    if (machine_->parts().course.isStopping()) return;
    must(std::fabs(axes.target(kZAxis) - z) < kHair || std::fabs(z) > kMostTravel,
         "the next move of z begins elsewhere");
  }

  void pass(int ms) {
    for (int i = 0; i < ms; ++i) {
      ++now_ms_;
      out_queue_ = std::max(0, out_queue_ - int(now_ms_ % 8 == 0 ? 5 : 6));
      eeprom.advance(1000);
      const int tick_ms = machine_ != nullptr ? 1000 / machine_->ticksPerSecond() : 10;
      if (now_ms_ % tick_ms != 0) continue;
      for (SimulatedMotor& motor : motor_) motor.advance(tick_ms / 1000.0);
      if (machine_ != nullptr) machine_->tick();
    }
    credit_ = std::min(credit_ + kBytesPerMs * ms, double(kInRoom));
    while (!is_ending_ && credit_ >= 1 && now_ms_ >= wait_until_ms_ && at_ < story_.sent.size() &&
           maySend())
      send(story_.sent[at_++]);
  }

  bool maySend() {
    if (int(wire_.size()) >= kInRoom) return false;
    const bool in_line = at_ > 0 && story_.sent[at_ - 1] != '\n';
    if (!story_.is_polite || in_line || (wire_.empty() && answers_.isComplete())) {
      asked_ms_ = now_ms_;
      return true;
    }
    return now_ms_ - asked_ms_ > kPatienceMs;
  }

  void send(char character) {
    switch (character) {
      case 1:
        wait_until_ms_ = now_ms_ + 100;
        return;
      case 2:
        wait_until_ms_ = now_ms_ + 2000;
        return;
      case 3:
        motor_[kLeftAxis].stuck = !motor_[kLeftAxis].stuck;
        return;
      case 4:
        motor_[kRightAxis].unplugged = !motor_[kRightAxis].unplugged;
        return;
      case 5:
        touches_ = !touches_;
        return;
      case 6:
        throw PowerCut();
      case 7:
        lost_ = 1;
        return;
      default:
        credit_ -= 1;
        wire_ += character;
    }
  }

  bool isTold() {
    if (at_ < story_.sent.size() || !wire_.empty() || !answers_.isComplete()) quiet_ms_ = now_ms_;
    return now_ms_ - quiet_ms_ > kQuietMs || now_ms_ > kStoryMs;
  }

  void end() {
    is_ending_ = true;
    end_ms_ = now_ms_;
    answers_.takeSettings();
    askAtTheEnd();
  }

  void askAtTheEnd() { wire_ = answers_.isOfGrbl() ? kResetAndAsk : kStopAndAsk; }

  void lookForEnd() {
    must(now_ms_ - end_ms_ < kLastPatienceMs, "no settings after a stop");
    if (!wire_.empty() || !answers_.isComplete()) return;
    // A motor that is held may raise its alarm while it brakes, and that drops the question.
    if (answers_.isLocked()) return askAtTheEnd();
    must(answers_.takeSettings() > 40, "not all settings are shown after a stop");
    throw TheEnd();
  }

  const Story& story_;
  Machine* machine_ = nullptr;
  ::Answers answers_;
  SimulatedMotor motor_[kAxisCount];
  std::string wire_, partial_;
  std::size_t at_ = 0;
  double credit_ = 0;
  int out_queue_ = 0, lost_ = 0;
  long now_ms_ = 0, last_line_ms_ = 0, quiet_ms_ = 0, asked_ms_ = 0, end_ms_ = 0,
       wait_until_ms_ = 0;
  bool touches_ = false, is_ending_ = false, is_greeting_ = true;
};

}  // namespace

std::vector<uint8_t> live(const Story& story) {
  World world(story);
  for (;;) {
    try {
      world.liveOnce();
    } catch (const PowerCut&) {
      world.restart();
    } catch (const TheEnd&) {
      return world.eeprom.bytes;
    }
  }
}

const std::vector<uint8_t>& ownImage() {
  static const std::vector<uint8_t> image = [] {
    Story story;
    story.sent =
        "$7=2\n$8=139.1\n$29=1300\n$63=0.00137293\n$160=8.2e-12\n$170=5.2e-6\n\x02"
        "B06 L1651 R1651\n\x02";
    return live(story);
  }();
  return image;
}
