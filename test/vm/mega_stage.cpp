// Pins of shield v1.2, with chains over the top of their sprockets.
#include "mega_stage.h"

#include <algorithm>

using machine::Axis;
using machine::kAxisCount;

namespace vm {
namespace {

// Bridge inputs in the order that means "wind in", and the pin of the PWM.
struct DriverPins {
  int one, two, enable;
};

const DriverPins kDrivers[kAxisCount] = {{12, 11, 10}, {4, 6, 5}, {7, 9, 8}};
const int kSpindlePin = 17, kLaserPin = 16, kProbePin = 14;
const uint16_t kTimsk5 = 0x73, kOcr5b = 0x12a;
const int kSlicesPerMs = 4;  // no motor makes more edges in a millisecond
// The driver looks the same at a duty of zero and without power. A motor that follows its
// set-points is not at zero for so long.
const int kUnpoweredMs = 150;

}  // namespace

void EncoderPins::step(VirtualBoard& board, uint16_t count) {
  const int left = missing(count);
  if (left == 0) return;
  count_ = uint16_t(count_ + (left > 0 ? 1 : -1));
  // second, first: 00, 10, 11, 01
  const int phase = uint16_t(count_ - start_) % 4;
  board.setPin(second_, phase == 1 || phase == 2);
  board.setPin(first_, phase == 2 || phase == 3);
}

MegaStage::MegaStage(std::string elf, Stage& stage)
    : elf_(std::move(elf)), stage_(stage), encoders_{{{3, 2}, {20, 21}, {18, 19}}} {}

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
  spindle_ = std::make_unique<PulseMeter>(*board_, kSpindlePin);
  laser_ = std::make_unique<PulseMeter>(*board_, kLaserPin);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    encoders_[axis].restart(stage_.count(Axis(axis)));
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
  for (int axis = 0; axis < kAxisCount; ++axis)
    encoders_[axis].step(*board_, stage_.count(Axis(axis)));
}

int16_t MegaStage::dutyOf(Axis axis) const {
  const DriverPins& pins = kDrivers[axis];
  const int16_t duty = board_->pin(pins.enable).level;
  const bool one = board_->pin(pins.one).level != 0, two = board_->pin(pins.two).level != 0;
  if (one == two) return 0;
  return one ? duty : int16_t(-duty);
}

void MegaStage::showPins() {
  for (int i = 0; i < kAxisCount; ++i) {
    const Axis axis = Axis(i);
    const int16_t duty = dutyOf(axis);
    since_driven_ms_[axis] = duty != 0 ? 0 : since_driven_ms_[axis] + 1;
    if (since_driven_ms_[axis] < kUnpoweredMs)
      stage_.drive(axis, duty);
    else
      stage_.release(axis);
  }
  stage_.pulse(machine::Output::kSpindle, spindle_->level());
  stage_.pulse(machine::Output::kLaser, laser_->level());
  const uint8_t* const data = board_->avr()->data;
  const int pulse = data[kOcr5b] | data[kOcr5b + 1] << 8;  // [half a microsecond]
  stage_.turnServo(data[kTimsk5] == 0 ? machine::kNoServo : uint8_t((pulse - 1088) * 180 / 3712));
  board_->setPin(kProbePin, !stage_.probeTouches());
  // The stage tells its supply as the processor sees it: the reference in 1/1024 of the supply.
  board_->setSupply(1.1 * 1024 / (stage_.bandGap() + 0.5));
}

}  // namespace vm
