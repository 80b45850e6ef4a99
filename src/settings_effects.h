// The rows of the effects' parameters, from their registry: numbers and limits, without texts.
#pragma once

#include <Kinematics.h>
#include <Settings.h>

/// Looks for a parameter while the registry calls effect() for each of its entries.
struct EffectRow {
  uint8_t wanted;  ///< index of the parameter, counted over all effects
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

  /// Flattened, so that only the two limits of a parameter reach the board, not its texts. The
  /// limits are the plausible range, widened by its width on each side: a fit may stray, but a slip
  /// of the decimal point should be refused.
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
