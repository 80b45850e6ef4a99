// Time passes only where the firmware's main program waits.
#include "brain/host_brain.h"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "machine/machine.h"
#include "settings_flash.h"

namespace brain {
namespace {

const double kBytesPerMs = 5.88;  // 58,824 baud, ten bits each
const int kRoom = 255;            // [characters] that wait on either way
const int kMostSilent = 1000;     // [ms] of a main program, then the motors are let go

}  // namespace

void HostBrain::start() {
  stop();
  now_ms_ = 0;
  byte_credit_ = out_queue_ = lost_ = late_ms_ = silent_ticks_ = holds_ = 0;
  is_cut_off_ = has_hung_ = is_tick_due_ = is_ticking_ = false;
  over_top_ = true;
  failure_ = nullptr;
  for (int axis = 0; axis < machine::kAxisCount; ++axis) {
    encoders_[axis] = Encoder();
    encoders_[axis].at = world_.count(world::Axis(axis));
  }
  program_ = std::thread([this] { live(); });
}

void HostBrain::stop() {
  if (program_.joinable()) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_cut_off_ = true;
      left_ms_ = 1;
    }
    turn_.notify_all();
    program_.join();
    left_ms_ = 0;
  }
  for (const world::Axis axis : {world::kLeft, world::kRight, world::kZ}) world_.drive(axis, 0);
  input_.clear();
  received_.clear();
  levels_[0] = levels_[1] = 0;
  servo_ = machine::kNoServo;
}

void HostBrain::cutPower(unsigned draw) {
  stop();
  eeprom_.tear(uint8_t(draw));
}

void HostBrain::advance(int milliseconds, const std::function<bool()>& is_enough) {
  if (!isRunning()) {
    for (; milliseconds > 0; milliseconds = is_enough() ? 0 : milliseconds - 1)
      world_.advance(0.001);
    return;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  is_enough_ = is_enough;
  left_ms_ = milliseconds;
  turn_.notify_all();
  turn_.wait(lock, [this] { return left_ms_ == 0; });
  if (failure_) std::rethrow_exception(failure_);
}

void HostBrain::send(const std::string& characters) { input_ += characters; }

std::string HostBrain::takeSaid() {
  std::string said;
  said.swap(said_);
  return said;
}

void HostBrain::live() {
  try {
    awaitTurn();
    const FlashTable table;
    machine::Machine machine({*this, *this, *this, *this, eeprom_, table}, board_);
    machine.begin();
    tick_every_ms_ = 1000 / machine.ticksPerSecond();
    ticked_ = &machine;
    for (;;) machine.loop();
  } catch (const PowerGone&) {
  } catch (...) {
    failure_ = std::current_exception();
  }
  ticked_ = nullptr;
  handBack();
}

void HostBrain::awaitTurn() {
  std::unique_lock<std::mutex> lock(mutex_);
  turn_.wait(lock, [this] { return left_ms_ > 0; });
  if (is_cut_off_) throw PowerGone();
}

void HostBrain::handBack() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    left_ms_ = 0;
  }
  turn_.notify_all();
}

void HostBrain::idle() {
  noteAlive();
  do {
    passMillisecond();
    if (is_enough_() || --left_ms_ <= 0) {
      handBack();
      awaitTurn();
    }
  } while (late_ms_-- > 0);
  late_ms_ = 0;
}

void HostBrain::noteAlive() {
  // After a hang the main program runs one round before ticks may drive again.
  has_hung_ = silent_ticks_ * tick_every_ms_ >= kMostSilent && !has_hung_;
  if (!has_hung_) silent_ticks_ = 0;
}

void HostBrain::passMillisecond() {
  gaps_to_pass_ = 0;  // no tick waits for a millisecond
  passGap();
  ++now_ms_;
  out_queue_ = std::max(0, out_queue_ - int(now_ms_ % 8 == 0 ? 5 : 6));
  receive();
  world_.advance(0.001);
  eeprom_.advance(1000);
  if (ticked_ && now_ms_ % uint32_t(tick_every_ms_) == 0) callTick();
}

void HostBrain::receive() {
  byte_credit_ = std::min(byte_credit_ + kBytesPerMs, kBytesPerMs + 1);
  for (; !input_.empty() && byte_credit_ >= 1; byte_credit_ -= 1) {
    if (received_.size() < kRoom)
      received_ += input_.front();
    else
      ++lost_;
    input_.erase(0, 1);
  }
}

void HostBrain::callTick() {
  if (silent_ticks_ * tick_every_ms_ >= kMostSilent) return letGo();
  ++silent_ticks_;
  if (chance_ == 0) return runTick();
  const uint32_t kMostGaps = 256;  // roughly as many as fit into a tick's time
  is_tick_due_ = true;
  chance_ = chance_ * 1664525 + 1013904223;
  gaps_to_pass_ = int(chance_ >> 16) % int(kMostGaps);
}

void HostBrain::runTick() {
  is_tick_due_ = false;
  is_ticking_ = true;
  ticked_->tick();
  is_ticking_ = false;
}

void HostBrain::passGap() {
  if (!is_tick_due_ || is_ticking_ || holds_ != 0) return;
  if (gaps_to_pass_-- <= 0) runTick();
}

void HostBrain::letGo() {
  for (const world::Axis axis : {world::kLeft, world::kRight, world::kZ}) world_.drive(axis, 0);
  ticked_->noteHang();
}

int16_t HostBrain::read() {
  passGap();
  if (received_.empty()) return -1;
  const char character = received_.front();
  received_.erase(0, 1);
  return uint8_t(character);
}

uint8_t HostBrain::lost() {
  const int lost = std::min(lost_, 255);
  lost_ = 0;
  return uint8_t(lost);
}

uint16_t HostBrain::bandGap() {
  const double kReference = 1.1;  // [V]
  return uint16_t(kReference * 1024 / supply_ + 0.5);
}

void HostBrain::write(char character) {
  passGap();
  while (out_queue_ >= kRoom) idle();
  ++out_queue_;
  said_ += character;
}

uint16_t HostBrain::count(machine::Axis axis) {
  Encoder& encoder = encoders_[axis];
  const int32_t at = world_.count(world::Axis(axis));
  int moved = senseOf(axis) * (at - encoder.at);
  encoder.at = at;
  for (; encoder.to_miss > 0 && std::abs(moved) > 1; --encoder.to_miss) {
    moved -= moved > 0 ? 2 : -2;
    ++encoder.illegal;
  }
  return encoder.counted = uint16_t(encoder.counted + moved);
}

}  // namespace brain
