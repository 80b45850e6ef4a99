// From a chain's length to the links that the motor counts, and back: what makes links longer or
// shorter than nominal.
#pragma once

namespace reference {

/// The links of a chain. Zero in any field means that the effect is absent.
struct Links {
  double pitch = 0;  ///< [strain] of the links against their nominal length, without load
  double zero = 0;   ///< [mm] of chain past 12 o'clock when the count reads zero

  /// [mm] Length in nominal links of free chain that is `length` [mm] long without load and pulls
  /// with `tension` [N], the mean of both ends. Each tooth holds a link, however long it is: only
  /// free links carry the pitch error.
  double counted(double length, double tension) const {
    (void)tension;
    return length / (1 + pitch) - zero;
  }

  /// [mm] The length of that free chain, from its nominal links.
  double lengthOf(double count, double tension) const {
    (void)tension;
    return (count + zero) * (1 + pitch);
  }

  /// Every number by its name.
  template <class See>
  void visit(See see) {
    see("pitch", pitch);
    see("zero", zero);
  }
};

}  // namespace reference
