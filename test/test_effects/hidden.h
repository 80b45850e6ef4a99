// Machines with an additional effect, for lib/Kinematics and for the judge, whose mechanics hide
// the effect. Every effect of the registry is here, by its header: its examples, and the same in
// the judge's numbers.
#pragma once

#include <Kinematics.h>
#include <judged.h>
#include <math.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "reference/numbers.h"
#include "reference/reference.h"

const double kChainWeight = 0.00137293;  // [N/mm]
const double kSledWeight = 97.9;         // [N]
const double kCompliance = 5.17e-6;      // [1/N]
const double kRadius = 63.5 / 6.283185307179586;

struct Sized {
  int setting;
  double size;
};

/// Only the named effects, all others absent; throws for a number that no effect has.
inline kinematics::EffectParams<double> withEffects(std::initializer_list<Sized> named) {
  kinematics::EffectParams<double> effects = {};
  for (const Sized& sized : named)
    if (!effects.set(sized.setting, sized.size)) throw sized.setting;
  return effects;
}

/// Where the motors are [mm].
struct Motors {
  double gap = 2978.4, height = 1072.6;  // apart, and above the middle of the sheet
};

inline kinematics::Frame<double> frameUnder(const Motors& motors) {
  return {motors.gap,
          motors.height,
          0,
          139.1,
          kRadius,
          kSledWeight,
          kChainWeight,
          kinematics::Feed::kOverTop};
}

/// The chain of every machine here: it sags and stretches.
inline kinematics::EffectParams<double> usualChain() {
  const double ratio = kChainWeight / kSledWeight;
  return withEffects({{160, ratio * ratio / 24}, {170, kCompliance}});
}

/// A machine with an additional effect.
struct Hidden {
  std::string name;                              // effect and example
  kinematics::EffectParams<double> effects;      // of the machine
  kinematics::EffectParams<double> unsuspected;  // without the additional effect
  double allowed;                                // [mm] of chain
  double allowed_at_bit;                         // [mm]
};

inline void PrintTo(const Hidden& hidden, std::ostream* out) { *out << hidden.name; }

namespace hidden_detail {

struct Collect {
  std::vector<Hidden> all;
  int first = 0;  // of the effect's parameters among all

  template <class ThisEffect>
  void effect(int) {
    const bool every_machine_has_it = ThisEffect::usual(frameUnder({}), 0) > 0;
    for (uint8_t i = 0; i < ThisEffect::kExampleCount; ++i) {
      const kinematics::Example example = ThisEffect::example(i);
      Hidden hidden = {ThisEffect::info().name, usualChain(), usualChain(),
                       1e-3 * ThisEffect::kChainMicrometres, 1e-3 * ThisEffect::kBitMicrometres};
      if (example.label) hidden.name += std::string("_") + example.label;
      std::replace(hidden.name.begin(), hidden.name.end(), ' ', '_');
      for (int k = 0; k < ThisEffect::kParamCount; ++k) {
        if (every_machine_has_it)
          hidden.unsuspected.value[first + k] = 0;
        else
          hidden.effects.value[first + k] = example.size[k];
      }
      all.push_back(hidden);
    }
    first += ThisEffect::kParamCount;
  }
};

}  // namespace hidden_detail

/// A machine with these effects in addition to those of its chain.
inline Hidden hiddenBy(const std::string& name, const std::vector<Sized>& sizes, double allowed,
                       double allowed_at_bit) {
  Hidden hidden = {name, usualChain(), usualChain(), allowed, allowed_at_bit};
  for (const Sized& sized : sizes) hidden.effects.set(sized.setting, sized.size);
  return hidden;
}

/// All examples of all effects, and some larger ones or ones on both sides.
inline std::vector<Hidden> everyEffect() {
  hidden_detail::Collect collected;
  kinematics::Effects::For<double>::visit(collected);
  std::vector<Hidden> all = collected.all;
  all.push_back(hiddenBy("chain_plane_far_off", {{130, 3600}}, 0.006, 0.008));
  all.push_back(hiddenBy("chain_pitch_of_two_sizes", {{180, 0.002}, {181, 0.0005}}, 0.006, 0.008));
  all.push_back(hiddenBy("sprocket_runout_askew", {{190, -0.06}, {191, -0.08}}, 0.008, 0.012));
  all.push_back(hiddenBy("chain_zero_by_a_tooth", {{200, 6.35}, {201, -2}}, 0.005, 0.008));
  all.push_back(hiddenBy("sled_swing_far", {{120, 3}, {121, -2}}, 0.012, 0.020));
  return all;
}

inline kinematics::Machine<double> lawsWith(const std::vector<Sized>& sizes,
                                            const Motors& motors = {}) {
  return prepare(frameUnder(motors), hiddenBy("", sizes, 0, 0).effects);
}

/// Takes the judge's numbers as setJudge() gives them: a factor may come before its number.
struct Judged {
  std::map<std::string, double> numbers, factors;

  void set(const char* name, double value) { numbers[name] = value; }
  void scale(const char* name, double factor) {
    factors.insert({name, 1.0}).first->second *= factor;
  }
};

/// The judge's machine with the same frame and effects.
inline reference::Machine judge(const kinematics::EffectParams<double>& effects,
                                const Motors& motors = {}) {
  Judged judged;
  kinematics::setJudge(frameUnder(motors), effects, judged);
  reference::Machine machine;
  const std::map<std::string, double*> at = reference::numbersOf(machine);
  for (const auto& each : judged.numbers) reference::field(at, each.first) = each.second;
  for (const auto& each : judged.factors) reference::field(at, each.first) *= each.second;
  return machine;
}

/// Places [mm] all over the sheet.
inline std::vector<Eigen::Vector2d> sheetPlaces() {
  std::vector<Eigen::Vector2d> all;
  for (int i = 0; i <= 32; ++i)
    for (int j = 0; j <= 16; ++j) all.push_back({-1219.2 + 76.2 * i, -609.6 + 76.2 * j});
  return all;
}

/// The worse of both chains' differences [mm].
inline double worse(const kinematics::Chains<double>& ours, const Eigen::Vector2d& theirs) {
  return fmax(fabs(ours.left - theirs[0]), fabs(ours.right - theirs[1]));
}

/// Worst difference [mm] of inverse()'s lengths from the judge's over the sheet.
inline double worstOver(const kinematics::Machine<double>& laws, const reference::Machine& judge) {
  double found = 0;
  for (const Eigen::Vector2d& place : sheetPlaces()) {
    const reference::Hang truth = reference::hangAt(judge, place);
    if (!truth.solved) return 1e9;
    const kinematics::Point<double> at = {place.x(), place.y()};
    found = fmax(found, worse(inverse(laws, at).chains, truth.paid_out));
  }
  return found;
}

/// How far [mm] from a place the judge's sled hangs on the chains that inverse() pays out for it.
inline double missedBy(const kinematics::Machine<double>& laws, const Eigen::Vector2d& place,
                       const Eigen::Vector2d& theirs) {
  const kinematics::Point<double> at = {place.x(), place.y()};
  const kinematics::Hanging<double> hanging = hang(laws, at, true);
  const kinematics::Chains<double> ours = inverse(laws, at).chains;
  const kinematics::Strand<double>&left = hanging.strand[0], &right = hanging.strand[1];
  Eigen::Matrix2d slopes;
  slopes << left.cosine, -left.sine, -right.cosine, -right.sine;
  return (slopes.inverse() * (Eigen::Vector2d(ours.left, ours.right) - theirs)).norm();
}

/// The worst of that [mm] over the sheet, under motors 2.9 to 3.7 m apart and 400 to 760 mm above
/// it. Under low motors far apart 1 mm of both chains is 4 mm at the bit.
inline double worstAtTheBit(const Hidden& hidden) {
  double found = 0;
  for (double gap : {2900.0, 3300.0, 3700.0})
    for (double offset : {400.0, 580.0, 760.0}) {
      const Motors motors = {gap, 609.6 + offset};
      const kinematics::Machine<double> laws = prepare(frameUnder(motors), hidden.effects);
      const reference::Machine machine = judge(hidden.effects, motors);
      for (int i = 0; i <= 8; ++i)
        for (int j = 0; j <= 6; ++j) {
          const Eigen::Vector2d place(-1219.2 + 304.8 * i, -609.6 + 203.2 * j);
          const reference::Hang truth = reference::hangAt(machine, place);
          if (!truth.solved) return 1e9;
          found = fmax(found, missedBy(laws, place, truth.paid_out));
        }
    }
  return found;
}
