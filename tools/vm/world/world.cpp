// Motors pull chains, the judge hangs the sled, the sled pulls on the motors.
#include "world/world.h"

namespace world {
namespace {

const double kStillFor = 0.1;   // [s] after this time the sled is hung even if it hardly moved
const double kMoved = 0.5;      // [mm] after a chain moved this far the sled is hung
const double kNearSheet = 0.5;  // [mm] height of the bit below which each place counts

/// A motor of a chain. The sled's pull is added at each hang. The encoder is exact.
MotorConstants chainMotor(const Parts& parts, Axis axis) {
  MotorConstants constants = parts.seed ? anyMotor(3 * parts.seed + axis) : MotorConstants();
  constants.step = parts.motor_step;
  constants.load = 0;
  constants.count_noise = 0;
  return constants;
}

/// The motor of the z axis: the same motor on a screw that carries the router.
MotorConstants zMotor(const Parts& parts) {
  MotorConstants constants = chainMotor(parts, kZ);
  constants.counts_per_turn = 7560;
  constants.load = -0.02;
  return constants;
}

reference::Hand handOf(Axis axis) {
  return axis == kLeft ? reference::Hand::kLeft : reference::Hand::kRight;
}

Axis otherOf(Axis axis) { return axis == kLeft ? kRight : kLeft; }

}  // namespace

World::World(const Parts& parts, double paid_out)
    : sled_(parts.numbers, parts.friction, parts.over_top),
      motors_{{{chainMotor(parts, kLeft), parts.seed},
               {chainMotor(parts, kRight), parts.seed + 1},
               {zMotor(parts), parts.seed + 2}}},
      senses_{{parts.over_top ? 1 : -1, parts.over_top ? 1 : -1, 1}},
      laid_{{paid_out, paid_out, 0}},
      hang_every_(parts.hang_every),
      is_over_top_(parts.over_top) {
  for (Motor& motor : motors_) motor.is_powered = false;
  hang();
  if (!hangs_) throw std::invalid_argument("no sled can hang from chains of this length");
}

double World::radius() const {
  const double kMetre = 1000;  // [mm]
  return per_turn_[kLeft] / kTurn / kMetre;
}

void World::drive(Axis axis, int duty) {
  duties_[axis] = duty;
  // The enable pin pulses the bridge, so at a duty of zero the motor runs free.
  motors_[axis].is_powered = duty != 0;
  motors_[axis].is_shorted = false;
}

void World::brake(Axis axis) {
  drive(axis, 0);
  motors_[axis].is_shorted = true;
}

double World::travel(Axis axis) const {
  return laid_[axis] + motors_[axis].turns() * per_turn_[axis];
}

void World::hangAt(const Eigen::Vector2d& place) {
  const Eigen::Vector2d paid_out = sled_.chainsTo(place);
  laid_[kLeft] += paid_out.x() - travel(kLeft);
  laid_[kRight] += paid_out.y() - travel(kRight);
  hang();
}

void World::hookAcross(Axis axis, double slack, double beyond) {
  if (axis == kZ || !is_over_top_)
    throw std::invalid_argument("a chain over the top of its sprocket can be hooked across");
  laid_[axis] += sled_.machine().motor_gap + beyond + slack - travel(axis);
  held_at_ = travel(otherOf(axis));
  across_ = reference::Across();
  hooked_ = axis;
  beyond_ = beyond;
  tighten();
  if (across_.solved) return;
  unhook();
  throw std::invalid_argument("no chain of this length hangs between the sprockets");
}

void World::unhook() {
  across_ = reference::Across();
  hooked_ = kZ;
  hang();
}

void World::advance(double seconds) {
  double sag = 0;
  for (const Motor& motor : motors_) sag += motor.sag();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    Motor& motor = motors_[axis];
    motor.weaker = lacking_ + sag - motor.sag();
    motor.run(-senses_[axis] * duties_[axis], seconds);
  }
  seconds_ += seconds;
  if (isHookedAcross()) return tighten();
  if (!isDue(seconds)) return;
  hang();
  sheet_.touch(seconds_, sled_.place(), travel(kZ));
}

bool World::isDue(double step) {
  const double looked = hang_every_ - step / 2;
  if (seconds_ - looked_ < looked) return false;
  looked_ = seconds_;
  if (travel(kZ) < kNearSheet || seconds_ - hung_ >= kStillFor - step / 2) return true;
  const Eigen::Vector2d ran = Eigen::Vector2d(travel(kLeft), travel(kRight)) - hung_on_;
  return ran.cwiseAbs().maxCoeff() > kMoved;
}

void World::tighten() {
  const Axis other = otherOf(hooked_);
  // The other motor turns too if its friction does not hold it.
  const double links = travel(hooked_) + travel(other) - held_at_;
  const reference::Across next =
      reference::stretchAcross(sled_.machine(), handOf(hooked_), links, beyond_, across_);
  // It keeps its last pull where the judge finds none.
  if (next.solved) across_ = next;
  motors_[hooked_].pull = across_.pull.norm() * radius();
  motors_[other].pull = across_.other_pull.norm() * radius();
}

void World::hang() {
  hung_ = seconds_;
  hung_on_ = {travel(kLeft), travel(kRight)};
  hangs_ = sled_.hang(hung_on_);
  motors_[kLeft].pull = sled_.leftTension() * radius();
  motors_[kRight].pull = sled_.rightTension() * radius();
}

}  // namespace world
