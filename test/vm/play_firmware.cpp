// Plays a dialogue with the firmware as it is flashed, on a simulated Mega with motors on its pins:
// `play_firmware ELF FOLDER DIALOGUE`. At the end it prints measured figures, a line each.
// Exit code 0: all lines came as written, 1: a line differed, 2: the dialogue could not be played.
#include <cmath>
#include <cstdio>
#include <deque>
#include <memory>
#include <sstream>

#include "line_match.h"
#include "mega/virtual_board.h"
#include "script.h"
#include "virtual_motor.h"

namespace {

const double kPatience = 30;                 // [s] for a line that is expected
const avr_cycle_count_t kSlice = 800;        // 50 us, in which no motor makes two edges
const double kMainTop = 3300, kZTop = 2600;  // [counts/s] at full duty
const vm::MotorPins kLeft = {12, 11, 10, 3, 2};
const vm::MotorPins kRight = {4, 6, 5, 20, 21};
const int kLaser = 16;
const vm::MotorPins kZ = {7, 9, 8, 18, 19};

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A board with its three motors; a new board for each life between power cuts.
struct Machine {
  Machine(const std::string& elf, const std::vector<uint8_t>& eeprom)
      : board(elf),
        left(board, kLeft, kMainTop),
        right(board, kRight, kMainTop),
        z(board, kZ, kZTop) {
    board.setEeprom(eeprom);
  }

  void run(double seconds) {
    const avr_cycle_count_t end = board.avr()->cycle + avr_cycle_count_t(seconds * vm::kClock);
    while (board.avr()->cycle < end) {
      board.run(kSlice);
      for (vm::VirtualMotor* motor : {&left, &right, &z})
        motor->advance(double(kSlice) / vm::kClock);
      for (int i = 0; i < 3; ++i) {
        const double drive = (i == 0 ? left : i == 1 ? right : z).driveNow();
        most_drive[i] = std::max(most_drive[i], drive);
        least_drive[i] = std::min(least_drive[i], drive);
      }
    }
  }

  vm::VirtualBoard board;
  vm::VirtualMotor left, right, z;
  double most_drive[3] = {0, 0, 0}, least_drive[3] = {0, 0, 0};
};

/// Moves around a circle, in the words of a program for smooth curves.
struct Moves {
  double length = 0.05;  // [mm]
  bool with_z = false, round = false;

  void take(const std::string& word) {
    if (word == "z" || word == "round")
      (word == "z" ? with_z : round) = true;
    else
      length = std::atof(word.c_str());
  }

  std::string line(int index) const {
    const double kRadius = 5;  // [mm]
    const double angle = index * length / kRadius;
    char text[40];
    std::snprintf(text, sizeof text, "G%d X%.3f Y%.3f", round ? 3 : 1, kRadius * std::cos(angle),
                  kRadius * std::sin(angle));
    std::string line = text;
    if (round) line += " R5";
    if (with_z) {
      std::snprintf(text, sizeof text, " Z%.3f", 0.2 * std::sin(angle));
      line += text;
    }
    return line + "\n";
  }
};

class Player {
 public:
  explicit Player(std::string elf) : elf_(std::move(elf)) { restart(); }

  void play(const Step& step) {
    switch (step.kind) {
      case Step::kSend:
        machine_->board.send(step.text + "\n");
        return;
      case Step::kSendRaw:
        machine_->board.send(step.text);
        return;
      case Step::kExpect:
      case Step::kSkipTo:
        return expect(step);
      case Step::kAsk:
        return ask(step);
    }
  }

  void tellFigures() const {
    std::printf("first_line_ms %.0f\n", first_line_ms_);
    std::printf("stack %d\n", machine_->board.mainStack() + machine_->board.interruptStack());
    std::printf("tick_share %.4f\n", machine_->board.tickShare());
    std::printf("longest_tick %ld\n", machine_->board.longestTick());
  }

 private:
  void restart() {
    const std::vector<uint8_t> eeprom =
        machine_ ? machine_->board.eeprom() : std::vector<uint8_t>(4096, 0xff);
    machine_ = std::make_unique<Machine>(elf_, eeprom);
    lines_.clear();
  }

  /// The next line that is no report.
  void takeLines() {
    std::deque<std::string>& came = machine_->board.lines;
    if (!came.empty() && first_line_ms_ == 0) first_line_ms_ = machine_->board.seconds() * 1000;
    for (; !came.empty(); came.pop_front())
      if (came.front().compare(0, 1, "<") != 0 && came.front().compare(0, 4, "[PE:") != 0)
        lines_.push_back(came.front());
  }

  void expect(const Step& step) {
    const Expected expected = readExpected(step.text);
    for (double waited = 0; waited < kPatience; waited += 0.001) {
      takeLines();
      while (!lines_.empty()) {
        const std::string line = lines_.front();
        lines_.pop_front();
        if (matches(line, expected)) return;
        if (step.kind == Step::kExpect) throw Failure("came instead: " + line);
      }
      machine_->run(0.001);
    }
    throw Failure("nothing came");
  }

  void ask(const Step& step) {
    std::istringstream words(step.text);
    std::string verb, rest;
    words >> verb >> rest;
    if (verb == "wait") return machine_->run(std::atof(rest.c_str()));
    if (verb == "power") return restart();
    if (verb == "straps") {
      restart();
      return machine_->board.strap(uint8_t(std::atoi(rest.c_str())));
    }
    if (verb == "stream") {
      Moves moves;
      for (std::string word; words >> word;) moves.take(word);
      return stream(std::atoi(rest.c_str()), moves);
    }
    if (verb == "stack") return machine_->board.followStack();
    if (verb == "hang") return hang(rest);
    if (verb == "overrun") return machine_->board.overrunStack();
    if (verb == "supply") return machine_->board.setSupply(std::atof(rest.c_str()));
    if (verb == "low") return machine_->board.setPin(std::atoi(rest.c_str()), false);
    if (verb == "wake") return machine_->board.wake(std::atof(rest.c_str()));
    if (verb == "undriven") return askUndriven(rest);
    if (verb == "hold") return machine_->board.holdInterrupts();
    if (verb == "allow") return machine_->board.allowInterrupts();
    if (verb == "stop") return machine_->board.stopTickTimer();
    if (verb == "off" || verb == "on") return askPower(verb == "on");
    if (verb == "resets") return tellOr(machine_->board.resets() == std::atoi(rest.c_str()));
    if (verb == "laser")
      return tellOr((machine_->board.pin(kLaser).level != 0) == (rest == "high"));
    if (verb == "telemetry") return readTelemetry();
    if (verb == "measure") return measure(std::atof(rest.c_str()));
    const int axis = rest == "left" ? 0 : rest == "right" ? 1 : 2;
    const bool winds = verb == "wound" && machine_->most_drive[axis] > 0.1;
    const bool pays = verb == "paid" && machine_->least_drive[axis] < -0.1;
    if (!winds && !pays) throw Failure("it did not");
  }

  /// In the control tick (`tick`), where the main program begins a report (`report`), or anywhere.
  void hang(const std::string& where) {
    for (double waited = 0; where == "report" && !machine_->board.reports(); waited += 0.00005) {
      if (waited > 1) throw Failure("no report came");
      machine_->run(0.00005);
    }
    machine_->board.hang(where == "tick");
  }

  static void tellOr(bool holds) {
    if (!holds) throw Failure("it is not so");
  }

  /// Whether both chain motors are driven, or neither is.
  void askPower(bool on) const {
    for (const vm::VirtualMotor* motor : {&machine_->left, &machine_->right})
      tellOr((motor->driveNow() != 0) == on);
  }

  /// Whether no motor was driven since `from now`.
  void askUndriven(const std::string& since) {
    for (int i = 0; i < 3; ++i) {
      double &most = machine_->most_drive[i], &least = machine_->least_drive[i];
      if (since.empty()) tellOr(most == 0 && least == 0);
      most = least = 0;
    }
  }

  /// Asks the firmware for its state (B30) and prints each number as a figure.
  void readTelemetry() {
    machine_->board.send("B30\n");
    expect({Step::kExpect, "B30", ""});
    for (double waited = 0; lines_.empty() && waited < 1; waited += 0.001) {
      machine_->run(0.001);
      takeLines();
    }
    if (lines_.empty()) throw Failure("no telemetry came");
    std::istringstream fields(lines_.front().substr(0, lines_.front().rfind(']')));
    lines_.pop_front();
    for (std::string field; std::getline(fields, field, '|');) {
      const std::size_t colon = field.find(':');
      if (colon == std::string::npos) continue;
      std::istringstream values(field.substr(colon + 1));
      std::string value;
      for (int i = 0; std::getline(values, value, ','); ++i)
        if (numberLength(value.c_str()) == value.size())
          std::printf("said_%s_%d %s\n", field.substr(0, colon).c_str(), i, value.c_str());
    }
    expect({Step::kExpect, "ok", ""});
  }

  /// Prints the share of the next seconds that the control tick takes.
  void measure(double seconds) {
    machine_->board.watchTicksFromNow();
    machine_->run(seconds);
    tellTicks("moving");
  }

  void tellTicks(const char* when) const {
    const vm::VirtualBoard& board = machine_->board;
    std::printf("tick_share_%s %.4f\n", when, board.tickShare());
    std::printf("longest_tick_%s %ld\n", when, board.longestTick());
    std::printf("longest_gap_%s %ld\n", when, board.longestGap());
    std::printf("ticks_per_second_%s %.2f\n", when, board.ticksPerSecond());
    std::printf("sleep_share_%s %.4f\n", when, board.sleepShare());
  }

  /// Sends moves as fast as they are acknowledged, 126 characters ahead; prints
  /// the speed.
  void stream(int count, const Moves& moves) {
    std::deque<std::size_t> unanswered;
    std::size_t waiting = 0;
    int sent = 0, answered = 0;
    const double start = machine_->board.seconds();
    machine_->board.watchTicksFromNow();
    while (answered < count) {
      const std::string text = moves.line(sent);
      const std::size_t length = text.size();
      if (sent < count && waiting + length <= 126) {
        machine_->board.send(text);
        unanswered.push_back(length);
        waiting += length;
        ++sent;
        continue;
      }
      machine_->run(0.0005);
      takeLines();
      for (; !lines_.empty(); lines_.pop_front()) {
        if (lines_.front() != "ok") throw Failure("came instead: " + lines_.front());
        waiting -= unanswered.front();
        unanswered.pop_front();
        ++answered;
      }
    }
    tellTicks("streaming");
    const double lines_per_second = count / (machine_->board.seconds() - start);
    std::printf("lines_per_second %.1f\n", lines_per_second);
    std::printf("mm_per_minute %.0f\n", lines_per_second * moves.length * 60);
  }

  std::string elf_;
  std::unique_ptr<Machine> machine_;
  std::deque<std::string> lines_;
  double first_line_ms_ = 0;  // after the first power-on
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "play_firmware: give ELF FOLDER DIALOGUE\n");
    return 2;
  }
  std::vector<Step> steps;
  std::string place;
  try {
    steps = readScript(argv[2], argv[3]);
    Player player(argv[1]);
    for (const Step& step : steps) {
      place = step.place + ": " + step.text;
      player.play(step);
    }
    player.tellFigures();
    return 0;
  } catch (const Failure& failure) {
    std::fprintf(stderr, "%s\n  %s\n", place.c_str(), failure.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "play_firmware: %s\n", error.what());
    return 2;
  }
}
