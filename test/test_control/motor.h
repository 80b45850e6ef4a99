// A gear motor under load as physics has it: torque against back-EMF, inertia, friction of two
// kinds, the pull of a chain, a supply that sags, and a coarse encoder. SI units inside.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace simulated {

/// A Maslow motor as seen at its sprocket; 12 V, about 20 turns a minute under load.
struct MotorConstants {
  double supply = 12.0;            ///< [V] without load
  double supply_resistance = 0.3;  ///< [ohm] by which it sags
  double resistance = 4.0;         ///< [ohm] of the winding
  double torque_constant = 4.6;    ///< [Nm/A] and [V s/rad] at the sprocket, gear included
  double inertia = 0.25;           ///< [kg m^2] of the rotor through the gear
  double coulomb = 1.5;            ///< [Nm] friction that only stands against motion
  double viscous = 0.4;            ///< [Nm s/rad]
  double load = 0.7;               ///< [Nm] pull of the chain, lengthening
  double counts_per_turn = 8113.73;
  double count_noise = 0.4;  ///< [counts] by which edges come early or late
};

/// What can be wrong with its wires.
struct Wires {
  bool motor_reversed = false, encoder_reversed = false, encoder_unplugged = false, blocked = false;
};

/// One motor. A positive duty lengthens the chain.
class Motor {
 public:
  Motor(const MotorConstants& constants, unsigned seed) : c_(constants), source_(seed) {}

  Wires wires;

  /// Lets `seconds` pass with a duty of -255 to 255.
  void run(int duty, double seconds) {
    const double kStep = 1e-4;  // [s] well below the mechanical time constant
    const double sign = wires.motor_reversed ? -1 : 1;
    for (double t = 0; t < seconds - kStep / 2; t += kStep) {
      const double share = sign * duty / 255.0;
      const double whole = c_.resistance + c_.supply_resistance * std::fabs(share);
      const double current = (share * c_.supply - c_.torque_constant * speed_) / whole;
      step(c_.torque_constant * current + c_.load, kStep);
    }
  }

  /// Turns since the start, as they are [turns].
  double turns() const { return angle_ / kTurn; }

  /// Counts as the board sees them.
  int32_t counts() {
    if (wires.encoder_unplugged) return told_;
    std::normal_distribution<double> early(0, c_.count_noise);
    const double sign = wires.encoder_reversed ? -1 : 1;
    told_ = int32_t(std::floor(sign * turns() * c_.counts_per_turn + early(source_)));
    return told_;
  }

 private:
  static constexpr double kTurn = 6.283185307179586;

  void step(double torque, double seconds) {
    if (wires.blocked) {
      speed_ = 0;
      return;
    }
    const bool still = speed_ == 0;
    if (still && std::fabs(torque) <= c_.coulomb) return;
    const double against =
        still ? std::copysign(c_.coulomb, torque) : std::copysign(c_.coulomb, speed_);
    const double before = speed_;
    speed_ += (torque - against - c_.viscous * speed_) / c_.inertia * seconds;
    // Friction stops a motion; it never turns it round.
    if (before * speed_ < 0 && std::fabs(torque) <= c_.coulomb) speed_ = 0;
    angle_ += speed_ * seconds;
  }

  MotorConstants c_;
  std::mt19937 source_;
  double angle_ = 0, speed_ = 0;
  int32_t told_ = 0;  ///< [counts] last
};

/// Motors as they come: every constant off by up to 30 %.
inline MotorConstants anyMotor(unsigned seed) {
  std::mt19937 source(seed);
  std::uniform_real_distribution<double> share(0.7, 1.3);
  MotorConstants c;
  for (double* one : {&c.resistance, &c.inertia, &c.coulomb, &c.viscous, &c.load})
    *one *= share(source);
  c.torque_constant *= 1 + (share(source) - 1) / 3;
  c.supply_resistance *= 2 * share(source);
  return c;
}

}  // namespace simulated
