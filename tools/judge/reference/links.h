// How many links a chain counts: what makes them longer or shorter than nominal, and back again.
#pragma once

#include <string>

namespace reference {

/// The links of one chain. Zero in any field means that the effect is absent.
struct Links {
  double pitch = 0;  ///< [strain] of the links against their nominal length, without load
  double zero = 0;   ///< [mm] of chain past 12 o'clock when the count reads zero

  /// [mm] in nominal links, of free chain that is `length` [mm] long without load. The teeth hold
  /// one link each, however long it is: only free links carry the pitch error.
  double counted(double length) const { return length / (1 + pitch) - zero; }

  /// [mm] the length of that free chain again.
  double lengthOf(double count) const { return (count + zero) * (1 + pitch); }

  /// Every number by its name.
  template <class See>
  void visit(See see) {
    see("pitch", pitch);
    see("zero", zero);
  }
};

}  // namespace reference
