// Time passes where the firmware's main program waits, as in an emulator that skips idle time.
#include "brain/host_brain.h"

#include <algorithm>
#include <memory>

#include "machine/machine.h"
#include "settings_flash.h"

namespace brain {
namespace {

const double kBytesPerMs = 5.88;             // 58,824 baud, ten bits each
const int kOutRoom = 255;                    // [characters] that wait to be sent
const machine::BoardName kShield = {2, ""};  // an L298

}  // namespace

void HostBrain::start() {
  stop();
  now_ms_ = 0;
  byte_credit_ = out_queue_ = 0;
  is_cut_off_ = false;
  failure_ = nullptr;
  for (int axis = 0; axis < machine::kAxisCount; ++axis)
    counts_at_start_[axis] = world_.count(world::Axis(axis));
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
}

void HostBrain::advance(int milliseconds) {
  if (!isRunning()) {
    for (int i = 0; i < milliseconds; ++i) world_.advance(0.001);
    return;
  }
  std::unique_lock<std::mutex> lock(mutex_);
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
    machine::Machine machine({*this, *this, *this, *this, eeprom_, table}, kShield);
    ticked_ = &machine;
    machine.begin();
    tick_every_ms_ = 1000 / machine.ticksPerSecond();
    tick_ = [](void* ticked) { static_cast<machine::Machine*>(ticked)->tick(); };
    for (;;) machine.loop();
  } catch (const PowerGone&) {
  } catch (...) {
    failure_ = std::current_exception();
  }
  tick_ = nullptr;
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
  passMillisecond();
  if (--left_ms_ > 0) return;
  handBack();
  awaitTurn();
}

void HostBrain::passMillisecond() {
  ++now_ms_;
  out_queue_ = std::max(0, out_queue_ - int(now_ms_ % 8 == 0 ? 5 : 6));
  byte_credit_ = std::min(byte_credit_ + kBytesPerMs, 12.0);
  world_.advance(0.001);
  eeprom_.advance(1000);
  if (tick_ && now_ms_ % uint32_t(tick_every_ms_) == 0) tick_(ticked_);
}

int16_t HostBrain::read() {
  if (input_.empty() || byte_credit_ < 1) return -1;
  byte_credit_ -= 1;
  const char character = input_.front();
  input_.erase(0, 1);
  return uint8_t(character);
}

void HostBrain::write(char character) {
  while (out_queue_ >= kOutRoom) idle();
  ++out_queue_;
  said_ += character;
}

uint16_t HostBrain::count(machine::Axis axis) {
  return uint16_t(world_.count(world::Axis(axis)) - counts_at_start_[axis]);
}

}  // namespace brain
