// Plays a dialogue with a firmware: sends its lines, waits, compares answers, asks and disturbs the
// machine that the firmware drives.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "brain/brain.h"
#include "script.h"
#include "world/world.h"

/// What went wrong, with the line of the dialogue.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What follows the verb of a question.
struct Words {
  explicit Words(std::string text);
  /// A number by its place; fails where the question has fewer.
  double number(std::size_t place = 0) const;

  std::string all, first;
  std::vector<double> numbers;
};

/// The world of most dialogues: the judge's machine with chains that weigh and stretch.
world::Parts partsOfDialogues();

/// The computer at the other end of the wire, and the hands at the machine. The same for the host's
/// build of the firmware and for the flashed program.
class Player {
 public:
  /// `world` is what `brain` drives; both must live as long as this object.
  Player(std::vector<Step> steps, world::World& world, brain::Brain& brain)
      : steps_(std::move(steps)), world_(world), brain_(brain) {}
  virtual ~Player() = default;

  /// From power-on to the dialogue's end, through every power cut in it; throws Failure.
  void play();

  /// Called every millisecond, for tests that watch the machine.
  std::function<void()> look = [] {};
  const std::string& status() const { return status_; }
  long millisecondsSinceStatus() const { return now_ms_ - status_ms_; }
  std::string whereInTheScript() const;

 protected:
  /// A question for some boards only; returns whether it is over.
  virtual bool askBoard(const std::string& verb, const Words& words);
  /// Starts the machine anew.
  virtual void start();

  /// Whether this step began at least `seconds` ago.
  bool hasWaited(double seconds) const { return double(now_ms_ - step_since_ms_) >= 1e3 * seconds; }
  void tellOr(bool holds, const std::string& what) const;
  [[noreturn]] void fail(const std::string& why) const;

  std::deque<std::string> lines_;  ///< that came and are no reports
  bool is_silence_allowed_ = false;
  bool is_asked_for_ = false;  ///< a status comes where `?` asks for it, and only there
  bool is_power_cut_ = false;
  long first_line_ms_ = 0;  ///< after the first power-on

 private:
  enum { kPatientMs = 150000 };  // for a line that is expected
  /// A question to any board; returns whether it is over.
  using Question = bool (Player::*)(const Words&);

  bool passMillisecond();
  void hear();
  void takeLine(const std::string& line);
  void watchMotors();
  bool takeStep(const Step& step);
  bool expect(const Step& step);
  bool ask(const Step& step);
  static const std::map<std::string, Question>& questions();

  bool wait(const Words& words);
  bool await(const Words& words);
  bool askAnswers(const Words& words);
  bool askQuiet(const Words& words);
  bool askStatus(const Words& words);
  bool askErrors(const Words& words);
  bool askSled(const Words& words);
  bool askChains(const Words& words);
  bool askHeight(const Words& words);
  bool askHold(const Words& words);
  bool askOff(const Words& words);
  bool askOn(const Words& words);
  bool askUndriven(const Words& words);
  bool askWound(const Words& words);
  bool askPaid(const Words& words);
  bool askSpindle(const Words& words);
  bool askLaser(const Words& words);
  bool askServo(const Words& words);
  bool askHalts(const Words& words);
  bool declare(const Words& words);
  bool stopWhenHalted(const Words& words);
  bool cutPower(const Words& words);
  bool setShield(const Words& words);
  bool disturb(const std::string& verb, const Words& words);

  bool askLevel(int level, const Words& words);
  Eigen::Vector2d placeNear(const Eigen::Vector2d& place) const;
  world::Axis axisOf(const Words& words) const;

  std::vector<Step> steps_;
  world::World& world_;
  brain::Brain& brain_;
  std::size_t at_ = 0;
  long now_ms_ = 0, step_since_ms_ = 0, last_line_ms_ = 0, status_ms_ = 0;
  std::string partial_, status_, errors_;
  std::optional<Words> question_;  // of this step, once it was read
  int answers_ = 0, halts_ = 0;
  bool stops_when_halted_ = false;
  std::optional<Eigen::Vector2d> held_at_;  // the bit when a hold was asked for
  long driven_ms_[world::kAxisCount] = {-1000, -1000, -1000};
  int most_duty_[world::kAxisCount] = {}, least_duty_[world::kAxisCount] = {};
};
