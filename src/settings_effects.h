// The rows of the effects' parameters, from their registry: numbers, and limits without the words.
#pragma once

#include <Kinematics.h>
#include <Settings.h>

/// Looks for one parameter while the registry calls effect() for each of its entries.
struct EffectRow {
  uint8_t wanted;  ///< which parameter, counted over all effects
  settings::Entry found;

  template <class ThisEffect>
  void effect(int first_setting) {
    parameter<ThisEffect, 0>(uint8_t(first_setting), Exists<(ThisEffect::kParamCount > 0)>());
    wanted = uint8_t(wanted - ThisEffect::kParamCount);
  }

 private:
  template <bool>
  struct Exists {};

  template <class ThisEffect, uint8_t kIndex>
  void parameter(uint8_t first_setting, Exists<true>) {
    if (wanted == kIndex) fill<ThisEffect, kIndex>(first_setting);
    parameter<ThisEffect, kIndex + 1>(first_setting,
                                      Exists<(kIndex + 1 < ThisEffect::kParamCount)>());
  }

  template <class ThisEffect, uint8_t kIndex>
  void parameter(uint8_t, Exists<false>) {}

  /// Flattened, so that of a parameter's words and numbers only the two limits reach the board.
  /// They are the plausible range and as much again on both sides: a fit may stray, a slip of the
  /// decimal point should not pass.
  template <class ThisEffect, uint8_t kIndex>
  __attribute__((flatten)) void fill(uint8_t first_setting) {
    const float low = float(ThisEffect::param(kIndex).low),
                high = float(ThisEffect::param(kIndex).high);
    found = {uint8_t(first_setting + kIndex),
             settings::Kind::kReal,
             settings::Access::kListed,
             settings::kAnyValue,
             settings::kGeometry,
             0.0f,
             low - (high - low),
             high + (high - low)};
  }
};

/// The row of an effect's parameter, counted over all effects in the registry's order.
inline settings::Entry effectRow(uint8_t index) {
  EffectRow row = {index, {}};
  kinematics::Effects::For<float>::visit(row);
  return row.found;
}
