// Runs the Mega for a millisecond, then the world for a millisecond.
#include "brain/mega_brain.h"

namespace brain {
namespace {

const int kSlicesPerMs = 4;  // no motor makes more edges in a millisecond
const int kFineSlices = 20;  // in each of them at most a character comes

}  // namespace

MegaBrain::MegaBrain(world::World& world, std::string elf, std::string bootloader)
    : world_(world), elf_(std::move(elf)), bootloader_(std::move(bootloader)) {
  // Loads the file once, so that an unreadable file is refused here.
  vm::VirtualBoard try_it(elf_, bootloader_);
}

void MegaBrain::start() {
  stop();
  board_ = std::make_unique<vm::VirtualBoard>(elf_, bootloader_);
  board_->setFlash(flash_);
  board_->setEeprom(eeprom_);
  board_->setSupply(supply_);
  board_->strap(uint8_t(shield_->straps));
  spindle_ = std::make_unique<vm::PulseMeter>(*board_, shield_->spindle);
  laser_ = std::make_unique<vm::PulseMeter>(*board_, shield_->laser);
  late_ms_ = 0;
  hangs_in_report_ = false;
  for (int axis = 0; axis < world::kAxisCount; ++axis)
    encoders_.of[axis].restart(*board_, uint16_t(world_.count(world::Axis(axis))));
}

void MegaBrain::stop() {
  if (board_) eeprom_ = board_->eeprom();
  if (board_ && !bootloader_.empty()) flash_ = board_->flash();
  spindle_.reset();
  laser_.reset();
  board_.reset();
  for (const world::Axis axis : {world::kLeft, world::kRight, world::kZ}) world_.drive(axis, 0);
}

void MegaBrain::advance(int milliseconds, const std::function<bool()>& is_enough) {
  for (; milliseconds > 0; milliseconds = is_enough() ? 0 : milliseconds - 1) {
    if (board_) passMillisecond();
    world_.advance(0.001);
  }
}

void MegaBrain::setShield(int version) {
  if (version != 2 && version != 3) throw std::invalid_argument("a shield is 2 or 3");
  shield_ = version == 2 ? &vm::kShield2 : &vm::kShield3;
}

void MegaBrain::delayProgram(int milliseconds) {
  board_->hang(false);
  late_ms_ = milliseconds;
}

void MegaBrain::setSupply(double volts) {
  supply_ = volts;
  if (board_) board_->setSupply(volts);
}

void MegaBrain::passMillisecond() {
  const double kAfterTick = 3;  // [ms]
  if (late_ms_ > 0 && --late_ms_ == 0) board_->wake(kAfterTick);
  const int slices = hangs_in_report_ ? kFineSlices : kSlicesPerMs;
  for (int slice = 0; slice < slices; ++slice) {
    turnEncoders();
    board_->runMs(1.0 / slices);
    if (!hangs_in_report_ || !board_->reports()) continue;
    hangs_in_report_ = false;
    board_->hang(false);
  }
  for (int axis = 0; axis < world::kAxisCount; ++axis) {
    const vm::DriverPins& driver = shield_->drivers[axis];
    if (driver.shorts(*board_))
      world_.brake(world::Axis(axis));
    else
      world_.drive(world::Axis(axis), driver.duty(*board_));
    driver.complain(*board_, world_.wires(world::Axis(axis)).driver_complains);
  }
  board_->setPin(shield_->probe, !world_.probeTouches());
}

void MegaBrain::turnEncoders() {
  for (int axis = 0; axis < world::kAxisCount; ++axis)
    encoders_.of[axis].step(*board_, uint16_t(world_.count(world::Axis(axis))));
}

std::string MegaBrain::takeSaid() {
  std::string said;
  if (!board_) return said;
  said.swap(board_->said);
  if (bootloader_.empty()) {  // whole lines; a bootloader knows none
    said.clear();
    for (const std::string& line : board_->lines) said += line + "\r\n";
  }
  board_->lines.clear();
  return said;
}

}  // namespace brain

/// For programs that load this when it is asked for: they need no simavr until then.
extern "C" brain::Brain* megaBrain(world::World& world, const std::string& elf,
                                   const std::string& bootloader) {
  return new brain::MegaBrain(world, elf, bootloader);
}
