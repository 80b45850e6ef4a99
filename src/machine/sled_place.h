// Where the sled is: found from the chains, kept over a power cut, said when it is not known.
#pragma once

#include <GCode.h>

#include "geometry.h"
#include "planner.h"
#include "position_keeper.h"
#include "printer.h"

namespace machine {

/// Where the tool is [mm].
struct Place {
  float x, y, z;
};

/// The place of the sled, three times: where it is, where the last queued move ends (aim), and
/// where the program believes that to be (counted: also beyond the sheet).
class SledPlace {
 public:
  SledPlace(Printer& out, Axes& axes, const Geometry& geometry, Planner& mover,
            PositionKeeper& keeper, settings::Memory& memory, const gcode::Modal& modal)
      : out_(out),
        axes_(axes),
        geometry_(geometry),
        planner_(mover),
        keeper_(keeper),
        memory_(memory),
        modal_(modal) {}

  /// Whether the chains say where the sled is, and can be trusted.
  bool isKnown() const { return is_known_; }
  /// Whether nothing has proved the chains or z wrong since they were declared.
  bool isTrusted() const { return keeper_.trustsAll(); }
  const Place& aim() const { return aim_; }
  Place counted() const { return {counted_.x, counted_.y, aim_.z}; }
  /// Whether the program believes to be elsewhere than the sled: beyond the sheet's edge.
  bool isCountedBeyond() const { return counted_.x != aim_.x || counted_.y != aim_.y; }

  void aimAt(const Place& place) { aim_ = place; }
  void aimAtZ(float z) { aim_.z = z; }
  void countFrom(float x, float y) { counted_ = {x, y}; }
  /// The program counts from where the sled is.
  void countFromAim() { counted_ = {aim_.x, aim_.y}; }

  /// Works the place out from the measured chains; everything begins there.
  bool search();
  /// The same, and says it.
  bool find();
  /// Everything begins at the place last worked out.
  void standHere();
  /// The tool is at this z from now on [mm].
  void declareZ(float z);
  /// Somebody said how long both chains are.
  void trustChains() { keeper_.declareChains(); }
  /// Lengths stay as they are, but counts mean others, or the chains another place.
  void reconsider() { keeper_.reconsider(); }
  /// Whether the lengths of both chains can be trusted.
  bool trustsChains() const { return keeper_.trustsChains(); }
  /// Somebody said where z is; nothing else changes.
  void trustZ() { keeper_.declareZ(); }

  /// At the start: takes over what was kept.
  void restore(const settings::Started& started);
  void sayUnset(bool has_defaults);
  /// The chains are not trusted from now on, and the owner hears why.
  void lose(FlashText why);
  /// Takes over which axes' counts were proved wrong.
  void doubtCounts();
  /// What must be set before the sled can cross the sheet.
  FlashText whatIsLost() const;
  /// Keeps the position once everything rests; to be called often.
  void keepWhenAtRest(uint32_t now_ms);

  /// Where the tool is commanded to be now.
  Place now(bool is_moving);

 private:
  void say() const;
  void sayLengths() const;
  FoundPlace byChains(float left, float right) const;

  Printer& out_;
  Axes& axes_;
  const Geometry& geometry_;
  Planner& planner_;
  PositionKeeper& keeper_;
  settings::Memory& memory_;
  const gcode::Modal& modal_;
  Place aim_ = {0, 0, 0};
  motion::Point<float> counted_ = {0, 0};  ///< [mm]
  Place place_ = {0, 0, 0};                ///< where the tool was when somebody last asked
  bool is_known_ = false;
};

}  // namespace machine
