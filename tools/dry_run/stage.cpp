// Time passes only where the firmware's main program waits, and then in the longest step in which
// nothing happens.
#include "stage.h"

#include <algorithm>
#include <cmath>

namespace dry_run {
namespace {

const double kBytesPerMs = 5.88;  // 58,824 baud, ten bits each
const size_t kAhead = 126;        // [characters] that a client sends without an answer
const machine::BoardName kShield = {2, "", machine::Start::kUsual};  // an L298

bool beginsWith(const std::string& line, const char* words) { return line.rfind(words, 0) == 0; }

}  // namespace

Stage::Stage() : machine_({*this, *this, *this, *this, eeprom_, table_}, kShield) {
  machine_.begin();
  tick_every_ms_ = 1000 / machine_.ticksPerSecond();
  is_started_ = true;
}

void Stage::send(const std::vector<std::string>& lines) {
  size_t next = 0;
  while (!is_halted_ && (next < lines.size() || !unanswered_.empty())) {
    for (; next < lines.size() && ahead_ + lines[next].size() + 1 <= kAhead; ++next) {
      on_the_way_.insert(on_the_way_.end(), lines[next].begin(), lines[next].end());
      on_the_way_.push_back('\n');
      unanswered_.push_back(lines[next].size() + 1);
      ahead_ += unanswered_.back();
    }
    machine_.loop();
  }
}

void Stage::drain() {
  while (!is_halted_ && !(machine_.parts().planner.isIdle() && machine_.parts().axes.isEmpty()))
    machine_.loop();
}

bool Stage::probeTouches() {
  // The face of the sheet is where z was declared to be 0.
  return machine_.parts().axes.length(machine::kZAxis) <= 0;
}

int16_t Stage::read() {
  noteQueued();
  if (arrived_.empty()) return -1;
  const char character = arrived_.front();
  arrived_.pop_front();
  return uint8_t(character);
}

void Stage::write(char character) {
  if (character != '\n') {
    if (character != '\r') partial_ += character;
    return;
  }
  std::string line;
  line.swap(partial_);
  take(line);
}

void Stage::take(const std::string& line) {
  if (line.empty() || line[0] == '<' || beginsWith(line, "[PE")) return;
  if (line == "ok" && spare_ > 0) {
    --spare_;
    return;
  }
  if (line != "ok") said_.push_back({answered_, line});
  if (line == "Maslow Paused") {
    // The operator has nothing to do here.
    arrived_.push_front('\n');
    arrived_.push_front('~');
    ++spare_;
  }
  is_halted_ = is_halted_ || beginsWith(line, "ALARM");
  if ((line != "ok" && !beginsWith(line, "error:")) || unanswered_.empty()) return;
  // A short move is answered before the main program next looks at the wire.
  noteQueued();
  ++answered_;
  --whole_lines_;
  ahead_ -= unanswered_.front();
  unanswered_.pop_front();
}

/// The feed [mm/min] that the program asks for a move of this length that goes at `feed` at most;
/// infinite for a rapid move, also that of a drilling cycle or of G28.
float Stage::asked(float feed, float way) const {
  const gcode::Modal& modal = machine_.parts().modal;
  if (modal.inverse_time) return modal.motion == 0 ? INFINITY : way * modal.inverse_feed;
  return modal.motion == 0 || feed > 1.001f * modal.feed ? INFINITY : modal.feed;
}

void Stage::noteQueued() {
  const motion::MoveQueue& queue = machine_.parts().planner.queue();
  const float per_minute = 60 * float(1000 / tick_every_ms_);
  for (uint8_t i = waiting_; i < queue.count(); ++i) {
    const motion::Move& move = queue.at(i);
    const float feed = move.feed * per_minute;
    const float across = move.path.drawn == motion::Drawn::kYes ? move.path.length : 0;
    const float way = std::hypot(across, move.z_to - z_);
    moves_.push_back({answered_, move.path, z_, move.z_to, asked(feed, way), feed,
                      move.top * per_minute, move.space == motion::Space::kChains, 0});
    z_ = move.z_to;
  }
  waiting_ = queue.count();
  if (waiting_ == 0) z_ = machine_.parts().axes.length(machine::kZAxis);
}

void Stage::noteEnded() {
  const uint8_t count = machine_.parts().planner.queue().count();
  const double at =
      seconds() + 1e-3 * double(tick_every_ms_ * int(machine_.parts().axes.waiting()));
  for (; waiting_ > count; --waiting_) moves_[ended_++].ends = at;
}

size_t Stage::forgetEnded() {
  const size_t count = ended_;
  moves_.erase(moves_.begin(), moves_.begin() + long(count));
  ended_ = 0;
  return count;
}

void Stage::idle() {
  noteEnded();
  const bool is_busy = whole_lines_ > 0 && answered_ == answered_at_rest_;
  answered_at_rest_ = answered_;
  pass(is_busy || (unanswered_.empty() && is_started_) ? untilTick() : 1);
}

void Stage::pass(int milliseconds) {
  now_ms_ += milliseconds;
  eeprom_.advance(1000 * milliseconds);
  byte_credit_ = std::min(byte_credit_ + kBytesPerMs * milliseconds, double(kAhead));
  for (; !on_the_way_.empty() && byte_credit_ >= 1; byte_credit_ -= 1) {
    whole_lines_ += on_the_way_.front() == '\n';
    arrived_.push_back(on_the_way_.front());
    on_the_way_.pop_front();
  }
  if (on_the_way_.empty()) byte_credit_ = std::min(byte_credit_, 1.0);
  if (is_started_ && now_ms_ % tick_every_ms_ == 0) machine_.tick();
}

}  // namespace dry_run
