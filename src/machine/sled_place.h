// Where the sled is: worked out from the chains, stored for power cuts, reported when it is lost.
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

/// Three places: where the sled is, where its last queued move ends (aim), and where the program
/// believes that end to be (counted: may be beyond the sheet).
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

  /// Whether the chains give a place for the sled, and can be trusted.
  bool isKnown() const { return is_known_; }
  /// Whether nothing has proved the chains or z wrong since they were declared.
  bool isTrusted() const { return keeper_.trustsAll(); }
  const Place& aim() const { return aim_; }
  Place counted() const { return {counted_.x, counted_.y, aim_.z}; }
  /// Whether the program's place is not the sled's: it is beyond the sheet's edge.
  bool isCountedBeyond() const { return counted_.x != aim_.x || counted_.y != aim_.y; }

  void aimAt(const Place& place) { aim_ = place; }
  void aimAtZ(float z) { aim_.z = z; }
  void countFrom(float x, float y) { counted_ = {x, y}; }
  /// From now on the program counts from where the sled is.
  void countFromAim() { counted_ = {aim_.x, aim_.y}; }

  /// Works out the place from the measured chains; all moves begin there.
  bool search();
  /// Works out the place as search() does, and says it: from now on the sled belongs there.
  bool find();
  /// All moves begin at the place that was worked out last.
  void standHere();
  /// Declares that the tool is at this z [mm].
  void declareZ(float z);
  /// Somebody said how long both chains are.
  void trustChains() { keeper_.declareChains(); }
  /// Lengths stay, but now counts mean other lengths, or the chains mean another place.
  void reconsider() { keeper_.reconsider(); }
  /// Whether the lengths of both chains can be trusted.
  bool trustsChains() const { return keeper_.trustsChains(); }
  /// Somebody said where z is; nothing else changes.
  void trustZ() { keeper_.declareZ(); }

  /// At the start: takes over the stored position.
  void restore(const settings::Started& started);
  void sayUnset(bool has_defaults);
  /// From now on the chains are not trusted; says why.
  void lose(settings::Doubt why);
  /// Takes over which axes' counts were proved wrong.
  void doubtCounts();
  void doubt(Axis axis, settings::Doubt why) { keeper_.doubt(axis, why); }
  /// What must be set before the sled can cross the sheet.
  FlashText whatIsLost() const;
  /// Stores the position once everything rests; to be called often.
  __attribute__((noinline)) void keepWhenAtRest(uint32_t now_ms);

  /// [mm] How far the axis that is farthest from its set-point is from it.
  float farthestOff() const;
  /// [mm] How far the tool moved while its motors were off, since its place was said.
  float movedBy() const { return moved_by_; }

  /// Where the tool is commanded to be now.
  Place now(bool is_moving);

 private:
  void say() const;
  void sayLengths() const;
  void followPulledChains();
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
  Place place_ = {0, 0, 0};                ///< where the tool was at the last call of now()
  Place left_at_ = {0, 0, 0};              ///< where the motors left the tool
  float moved_by_ = 0;                     ///< [mm]
  bool is_known_ = false;
};

}  // namespace machine
