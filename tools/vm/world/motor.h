// The physics of a gear motor under load: torque against back-EMF, inertia, two kinds of friction,
// the pull of a chain, play in the gear, the bridge's voltage drop, a supply that sags, and a
// coarse encoder on the motor's side of the gear. SI units inside.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace world {

const double kTurn = 6.283185307179586;  // [rad]

/// A Maslow motor as seen at its sprocket. Behind an L298 on 12 V it makes 20 turns a minute
/// without load and 18 against the chain's pull.
struct MotorConstants {
  double supply = 12.0;            ///< [V] without load
  double supply_resistance = 0.3;  ///< [ohm] makes the supply sag
  double bridge_drop = 1.8;        ///< [V] lost in the bridge
  double resistance = 4.0;         ///< [ohm] of the winding
  double torque_constant = 3.7;    ///< [Nm/A] and [V s/rad] at the sprocket, gear included
  double inertia = 0.25;           ///< [kg m^2] of the rotor through the gear
  double coulomb = 1.5;            ///< [Nm] friction against motion
  double stiction = 1;             ///< [1] times `coulomb`, until the motor moves
  double viscous = 0.4;            ///< [Nm s/rad]
  double load = 0.7;               ///< [Nm] pull of the chain, in the direction that lengthens
  double play = 0.011;             ///< [rad] of the sprocket between the flanks of the gear
  double sprocket_friction = 0.2;  ///< [Nm] share of `coulomb` behind the play
  double counts_per_turn = 8113.73;
  double step = 1e-4;        ///< [s] of the computation, well below the mechanical time constant
  double count_noise = 0.4;  ///< [counts] standard deviation of edges that come early or late
};

/// Fault of the motor's wires.
struct Wires {
  bool motor_reversed = false, encoder_reversed = false;
  bool motor_unplugged = false, encoder_unplugged = false;
  bool channel_lost = false;  ///< of the encoder: the count goes to and fro by 1
  bool blocked = false;
  bool driver_complains = false;  ///< it reports an error and gives no current
};

/// A motor. A positive duty lengthens the chain.
class Motor {
 public:
  Motor(const MotorConstants& constants, unsigned seed) : c_(constants), source_(seed) {}

  Wires wires;
  double weaker = 0;       ///< [V] by which the supply is low
  double pull = 0;         ///< [Nm] pull of the cut, in addition to the load
  double by_hand = 0;      ///< [rad/s] at which the sprocket of a motor without power is turned
  bool is_powered = true;  ///< without power no current flows: only friction brakes
  /// Without power, the bridge joins both ends of the winding: what the motor generates beyond the
  /// bridge's drop brakes it.
  bool is_shorted = false;

  /// Lets `seconds` pass with a duty of -255 to 255.
  void run(int duty, double seconds) {
    const double sign = wires.motor_reversed ? -1 : 1;
    const double share = sign * duty / 255.0;
    const double given = std::fabs(share) * (c_.supply - weaker) - c_.bridge_drop;
    const double volts = std::copysign(std::max(given, 0.0), share);
    const double whole = c_.resistance + c_.supply_resistance * std::fabs(share);
    // Without a supply the bridge conducts nothing, so it brakes nothing.
    const bool is_cut_off = wires.motor_unplugged || wires.driver_complains;
    const bool is_fed = is_powered && !is_cut_off && c_.supply - weaker > c_.bridge_drop;
    for (double t = 0; t < seconds - c_.step / 2; t += c_.step) {
      if (!is_fed) rotor_ += by_hand * c_.step;
      current_ = is_fed ? (volts - c_.torque_constant * speed_) / whole : shortCurrent();
      step(c_.torque_constant * current_, c_.step);
    }
  }

  /// [V] by which the motor's current makes the supply of all motors sag.
  double sag() const { return std::fabs(current_) * c_.supply_resistance; }

  /// Turns that it would still run on if its power went now.
  double turnsToRest() const {
    Motor motor = *this;
    motor.is_powered = motor.is_shorted = false;
    const int kLongest = 2000;  // [ms] beyond which the sled sinks
    for (int ms = 0; motor.speed_ != 0 && ms < kLongest; ++ms) motor.run(0, 0.001);
    return motor.turns() - turns();
  }

  /// Turns of the sprocket since the start.
  double turns() const { return sprocket_ / kTurn; }

  /// Counts as the board sees them.
  int32_t counts() {
    const double sign = wires.encoder_reversed ? -1 : 1;
    const double passed = sign * rotor_ / kTurn * c_.counts_per_turn - missed_;
    if (wires.encoder_unplugged) {
      missed_ += passed - reported_;
      return reported_;
    }
    const double seen = passed + earliness();
    if (wires.channel_lost)
      reported_ = kept_ + (int64_t(std::floor(seen)) / 2) % 2;
    else
      kept_ = reported_ = int32_t(std::floor(seen));
    return reported_;
  }

 private:
  /// [A] Current of a shorted winding; the supply gives nothing to it, but keeps the bridge awake.
  double shortCurrent() const {
    const bool is_awake = c_.supply - weaker > c_.bridge_drop;
    if (!is_shorted || !is_awake || wires.motor_unplugged || wires.driver_complains) return 0;
    const double beyond = std::fabs(c_.torque_constant * speed_) - c_.bridge_drop;
    return beyond > 0 ? -std::copysign(beyond, speed_) / c_.resistance : 0;
  }

  /// `torque` [Nm] of the winding.
  void step(double torque, double seconds) {
    if (wires.blocked) {
      speed_ = 0;
      return;
    }
    const double load = c_.load + pull;
    // If the chain's pull exceeds the sprocket's friction, the gear stays on the same flank.
    const bool hangs = load > c_.sprocket_friction;
    const double kOnFlank = 0.499;  // share of the play; rounding never reaches half of it
    const bool meshes =
        hangs || (speed_ >= 0 ? rotor_ - sprocket_ : sprocket_ - rotor_) >= kOnFlank * c_.play;
    turn(torque + (meshes ? load : 0), c_.coulomb - (meshes ? 0 : c_.sprocket_friction), seconds);
    sprocket_ =
        hangs ? rotor_ : std::min(std::max(sprocket_, rotor_ - c_.play / 2), rotor_ + c_.play / 2);
  }

  void turn(double torque, double friction, double seconds) {
    const bool still = speed_ == 0;
    if (still && std::fabs(torque) <= c_.stiction * friction) return;
    const double against = std::copysign(friction, still ? torque : speed_);
    const double before = speed_;
    speed_ += (torque - against - c_.viscous * speed_) / c_.inertia * seconds;
    // Friction stops a motion; it never reverses it.
    if (before * speed_ < 0 && std::fabs(torque) <= friction) speed_ = 0;
    rotor_ += speed_ * seconds;
  }

  /// [counts] By how much an edge comes early.
  double earliness() {
    if (c_.count_noise <= 0) return 0;
    return std::normal_distribution<double>(0, c_.count_noise)(source_);
  }

  MotorConstants c_;
  std::mt19937 source_;
  double rotor_ = 0, sprocket_ = 0, speed_ = 0;  // [rad], [rad/s], at the sprocket's side
  double current_ = 0;                           // [A]
  double missed_ = 0;                            // [counts] that passed an unplugged encoder
  int32_t reported_ = 0, kept_ = 0;  ///< [counts] last reported; last with both channels
};

/// Motors with random tolerances: every constant is off by up to 30 %. The chain of every fourth
/// motor is nearly slack, as the far chain is in a lower corner, so the gear moves in its play.
inline MotorConstants anyMotor(unsigned seed) {
  std::mt19937 source(seed);
  std::uniform_real_distribution<double> share(0.7, 1.3);
  MotorConstants c;
  for (double* constant : {&c.resistance, &c.inertia, &c.coulomb, &c.viscous, &c.load})
    *constant *= share(source);
  c.torque_constant *= 1 + (share(source) - 1) / 3;
  c.supply_resistance *= 2 * share(source);
  c.play *= share(source);
  c.sprocket_friction *= share(source);
  if (seed % 4 == 3) c.load *= 0.25;
  return c;
}

}  // namespace world
