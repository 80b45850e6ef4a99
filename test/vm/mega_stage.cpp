// Pins of shield v1.2, with chains over the top of their sprockets.
#include "mega_stage.h"

#include <algorithm>

using machine::Axis;
using machine::kAxisCount;

namespace vm {
namespace {

const int kSlicesPerMs = 4;  // no motor makes more edges in a millisecond
// The driver looks the same at a duty of zero and without power. A motor that follows its
// set-points is not at zero for so long.
const int kUnpoweredMs = 150;

}  // namespace

MegaStage::MegaStage(std::string elf, Stage& stage) : elf_(std::move(elf)), stage_(stage) {}

void MegaStage::live() {
  startBoard(std::vector<uint8_t>(4096, 0xff));
  for (;;) {
    try {
      for (;;) passMillisecond();
    } catch (const PowerGone&) {
      stage_.restart();
      startBoard(board_->eeprom());
    } catch (const TheEnd&) {
      return;
    }
  }
}

void MegaStage::startBoard(const std::vector<uint8_t>& eeprom) {
  board_ = std::make_unique<VirtualBoard>(elf_);
  board_->setEeprom(eeprom);
  spindle_ = std::make_unique<PulseMeter>(*board_, kShield2.spindle);
  laser_ = std::make_unique<PulseMeter>(*board_, kShield2.laser);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    encoders_.of[axis].restart(*board_, stage_.count(Axis(axis)));
    since_driven_ms_[axis] = kUnpoweredMs;
  }
}

void MegaStage::passMillisecond() {
  passWire();
  for (int slice = 0; slice < kSlicesPerMs; ++slice) {
    turnEncoders();
    board_->runMs(1.0 / kSlicesPerMs);
  }
  showPins();
  stage_.idle();
}

void MegaStage::passWire() {
  for (int16_t character = stage_.read(); character >= 0; character = stage_.read())
    board_->send(std::string(1, char(character)));
  for (; !board_->lines.empty(); board_->lines.pop_front()) {
    for (const char character : board_->lines.front()) stage_.write(character);
    stage_.write('\r');
    stage_.write('\n');
  }
}

void MegaStage::turnEncoders() {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    // The pairs come on the wires; the stage itself misses none.
    int& to_miss = stage_.motor(Axis(axis)).to_miss;
    encoders_.of[axis].miss(to_miss);
    to_miss = 0;
    encoders_.of[axis].step(*board_, stage_.count(Axis(axis)));
  }
}

void MegaStage::showPins() {
  for (int i = 0; i < kAxisCount; ++i) {
    const Axis axis = Axis(i);
    const int16_t duty = int16_t(kShield2.drivers[axis].duty(*board_));
    since_driven_ms_[axis] = duty != 0 ? 0 : since_driven_ms_[axis] + 1;
    if (kShield2.drivers[axis].shorts(*board_))
      stage_.brake(axis);
    else if (since_driven_ms_[axis] < kUnpoweredMs)
      stage_.drive(axis, duty);
    else
      stage_.release(axis);
  }
  stage_.pulse(machine::Output::kSpindle, spindle_->level());
  stage_.pulse(machine::Output::kLaser, laser_->level());
  stage_.turnServo(uint8_t(servoOf(*board_)));
  board_->setPin(kShield2.probe, !stage_.probeTouches());
  // The stage gives its supply as the processor measures it: the reference in 1/1024 of the supply.
  board_->setSupply(1.1 * 1024 / (stage_.bandGap() + 0.5));
}

}  // namespace vm
