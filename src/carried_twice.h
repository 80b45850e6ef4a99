// Corrections that are set twice: by a published setting and by an effect's own setting. The
// machine adds both (docs/decisions/0007-published-numbers-keep-their-meaning.md).
#pragma once

#include "settings_table.h"

/// The $-numbers that carry a correction of the published programs; 0 and 0 after the last.
struct Carriers {
  uint8_t published, ours;
};

/// Looks for a correction while the registry calls effect() for each of its entries.
struct CarriersSearch {
  uint8_t wanted;  ///< how many corrections come before the wanted correction
  Carriers found;

  template <class ThisEffect>
  void effect(int first_setting) {
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i) {
      const uint8_t number = uint8_t(ThisEffect::published(i).number);
      // A client's number that stands for the effect's setting is the same carrier.
      if (number == 0 || number == ThisEffect::kClientNumber) continue;
      if (wanted-- == 0) found = {number, uint8_t(first_setting + i)};
    }
  }
};

/// The carriers of a correction, counted from 0 in the registry's order.
PLUMB_RARE inline Carriers carriersOf(uint8_t correction) {
  CarriersSearch search = {correction, {0, 0}};
  kinematics::Effects::For<float>::visit(search);
  return search.found;
}

/// Whether both numbers carry a correction. A sled on two brackets ignores the published numbers.
PLUMB_RARE inline bool areBothSet(const settings::Values& values, const Carriers& carriers) {
  const settings::Table& table = values.table();
  return values.at(kKinematics) != 1 &&
         values.at(settings::indexOf(table, carriers.published)) != 0 &&
         values.at(settings::indexOf(table, carriers.ours)) != 0;
}
