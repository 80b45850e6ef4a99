// Questions of a dialogue that only the simulated Mega answers.
#include "mega_player.h"

#include <cmath>
#include <cstdio>
#include <sstream>

#include "test_dialogues/line_match.h"

namespace vm {
namespace {

const std::size_t kAhead = 126;  // [characters] that a sender has unanswered

}  // namespace

/// A sender's question ten times a second, as CNCjs and UGS ask it.
struct StatusQuestion {
  enum { kPeriodMs = 100 };
  long asked_ms = -kPeriodMs;
  bool is_open = false;
  int count = 0;
  long longest_ms = 0;  ///< from the question to the end of its answer
};

/// Moves around a circle, as a program for smooth curves writes them, as fast as they are
/// acknowledged.
class Stream {
 public:
  /// `words`: how many, then the length [mm] of each, `z`, `round` and `asked` as wanted.
  Stream(const Words& words, double now) : count_(int(words.number())), began_(now) {
    std::istringstream rest(words.all.substr(words.first.size()));
    for (std::string word; rest >> word;)
      if (word == "z" || word == "round" || word == "asked")
        (word == "z" ? with_z_ : word == "round" ? round_ : asked_) = true;
      else
        length_ = std::atof(word.c_str());
  }

  /// The lines that may be sent now.
  std::string due() {
    std::string text;
    for (std::string line = next(); sent_ < count_ && waiting_ + line.size() <= kAhead;
         line = next()) {
      text += line;
      waiting_ += line.size();
      lengths_.push_back(line.size());
      ++sent_;
    }
    return text;
  }

  void takeAnswer() {
    waiting_ -= lengths_.front();
    lengths_.pop_front();
    ++answered_;
  }

  bool isOver() const { return answered_ == count_; }
  const char* name() const { return asked_ ? "asked" : "streaming"; }

  /// A `?` where it is due; `status_ms`: since the last status came.
  const char* question(long now_ms, long status_ms) {
    if (question_.is_open && status_ms < now_ms - question_.asked_ms) {
      question_.is_open = false;
      question_.longest_ms =
          std::max(question_.longest_ms, now_ms - status_ms - question_.asked_ms);
    }
    if (!asked_ || question_.is_open || now_ms - question_.asked_ms < StatusQuestion::kPeriodMs)
      return "";
    question_.asked_ms = now_ms;
    question_.is_open = true;
    ++question_.count;
    return "?";
  }

  void tellSpeed(double now) const {
    const double lines_per_second = count_ / (now - began_);
    const char* of = asked_ ? "_asked" : "";
    std::printf("lines_per_second%s %.1f\n", of, lines_per_second);
    std::printf("mm_per_minute%s %.0f\n", of, lines_per_second * length_ * 60);
    if (!asked_) return;
    std::printf("questions_per_second %.2f\n", question_.count / (now - began_));
    std::printf("longest_answer_ms %ld\n", question_.longest_ms);
  }

 private:
  std::string next() const {
    const double kRadius = 5;  // [mm]
    const double angle = sent_ * length_ / kRadius;
    char text[60];
    std::snprintf(text, sizeof text, "G%d X%.3f Y%.3f%s", round_ ? 3 : 1, kRadius * std::cos(angle),
                  kRadius * std::sin(angle), round_ ? " R5" : "");
    std::string line = text;
    if (with_z_) {
      std::snprintf(text, sizeof text, " Z%.3f", 0.2 * std::sin(angle));
      line += text;
    }
    return line + "\n";
  }

  double length_ = 0.05;  // [mm]
  bool with_z_ = false, round_ = false, asked_ = false;
  StatusQuestion question_;
  int count_, sent_ = 0, answered_ = 0;
  double began_;  // [s]
  std::size_t waiting_ = 0;
  std::deque<std::size_t> lengths_;
};

MegaPlayer::MegaPlayer(std::vector<Step> steps, world::World& world, brain::MegaBrain& mega)
    : Player(std::move(steps), world, mega), mega_(mega) {}

MegaPlayer::~MegaPlayer() = default;

void MegaPlayer::start() {
  Player::start();
  if (straps_ >= 0) mega_.board().strap(uint8_t(straps_));
  straps_ = -1;
}

bool MegaPlayer::askBoard(const std::string& verb, const Words& words) {
  const auto is = [&](const char* other) { return verb == other; };
  if (is("stream")) return stream(words);
  if (is("telemetry")) return readTelemetry();
  if (is("measure")) return measure(words.number());
  if (is("freeze")) return freeze(words.all);
  if (is("straps")) {
    straps_ = int(words.number());
    return is_power_cut_ = true;
  }
  if (is("stack"))
    mega_.board().followStack();
  else if (is("low"))
    mega_.board().setPin(int(words.number()), false);
  else if (is("resets"))
    tellOr(mega_.board().resets() == int(words.number()),
           std::to_string(mega_.board().resets()) + " came");
  else if (!disturbProgram(verb, words))
    return Player::askBoard(verb, words);
  return true;
}

bool MegaPlayer::disturbProgram(const std::string& verb, const Words& words) {
  is_silence_allowed_ = true;
  if (verb == "overrun")
    mega_.board().overrunStack();
  else if (verb == "wake")
    mega_.board().wake(words.number());
  else if (verb == "mask")
    mega_.board().holdInterrupts();
  else if (verb == "unmask")
    mega_.board().allowInterrupts();
  else if (verb == "stop")
    mega_.board().stopTickTimer();
  else
    return false;
  return true;
}

/// In the control tick (`tick`), where the main program begins a report (`report`), or anywhere.
bool MegaPlayer::freeze(const std::string& where) {
  is_silence_allowed_ = true;
  if (where != "report") {
    mega_.board().hang(where == "tick");
    return true;
  }
  if (!is_asking_) mega_.hangInReport();
  is_asking_ = mega_.willHang();
  if (is_asking_ && hasWaited(1)) fail("no report came");
  return !is_asking_;
}

/// Asks the firmware for its state (B30) and prints each number as a figure.
bool MegaPlayer::readTelemetry() {
  if (!is_asking_) {
    mega_.send("B30\n");
    is_asking_ = true;
    return false;
  }
  if (hasWaited(1)) fail("no telemetry came");
  if (lines_.size() < 3) return false;
  if (lines_[0] != "B30" || lines_[2] != "ok") fail("came instead: " + lines_[0] + lines_[2]);
  is_asking_ = false;
  std::istringstream fields(lines_[1].substr(0, lines_[1].rfind(']')));
  lines_.erase(lines_.begin(), lines_.begin() + 3);
  for (std::string field; std::getline(fields, field, '|');) {
    const std::size_t colon = field.find(':');
    if (colon == std::string::npos) continue;
    std::istringstream values(field.substr(colon + 1));
    std::string value;
    for (int i = 0; std::getline(values, value, ','); ++i)
      if (numberLength(value.c_str()) == value.size())
        std::printf("said_%s_%d %s\n", field.substr(0, colon).c_str(), i, value.c_str());
  }
  return true;
}

/// Prints the share of the next seconds that the control tick takes.
bool MegaPlayer::measure(double seconds) {
  if (!is_asking_) mega_.board().watchTicksFromNow();
  is_asking_ = !hasWaited(seconds);
  if (!is_asking_) tellTicks("moving");
  return !is_asking_;
}

bool MegaPlayer::stream(const Words& words) {
  const double now = mega_.board().seconds();
  if (!stream_) {
    stream_ = std::make_unique<Stream>(words, now);
    mega_.board().watchTicksFromNow();
  }
  for (; !lines_.empty(); lines_.pop_front()) {
    if (lines_.front() != "ok") fail("came instead: " + lines_.front());
    stream_->takeAnswer();
  }
  mega_.send(stream_->due());
  mega_.send(stream_->question(std::lround(now * 1000), millisecondsSinceStatus()));
  if (!stream_->isOver()) return false;
  tellTicks(stream_->name());
  stream_->tellSpeed(now);
  stream_.reset();
  return true;
}

void MegaPlayer::tellTicks(const char* when) {
  const VirtualBoard& board = mega_.board();
  std::printf("tick_share_%s %.4f\n", when, board.tickShare());
  std::printf("longest_tick_%s %ld\n", when, board.longestTick());
  std::printf("longest_gap_%s %ld\n", when, board.longestGap());
  std::printf("ticks_per_second_%s %.2f\n", when, board.ticksPerSecond());
  std::printf("sleep_share_%s %.4f\n", when, board.sleepShare());
}

void MegaPlayer::tellFigures() {
  const VirtualBoard& board = mega_.board();
  std::printf("first_line_ms %ld\n", first_line_ms_);
  std::printf("stack %d\n", board.mainStack() + board.interruptStack());
  std::printf("tick_share %.4f\n", board.tickShare());
  std::printf("longest_tick %ld\n", board.longestTick());
}

}  // namespace vm
