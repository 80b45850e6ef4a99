// Where the sled is: worked out from the chains, stored for power cuts, reported when it is lost.
#pragma once

#include "flash_text.h"
#include "geometry.h"
#include "program_place.h"

namespace machine {

struct Parts;

/// Knowledge of the place of the sled.
enum class Whereabouts : uint8_t {
  kLost,     ///< the lengths of the chains are not known
  kNowhere,  ///< the lengths are known, but no sled can hang on such chains
  kFound,    ///< the place is known
};

/// Why the place is worked out from the chains. It decides whether the place is reported.
enum class Search : uint8_t {
  kStart,         ///< the machine starts
  kDeclared,      ///< the lengths of the chains were declared
  kCentred,       ///< the chains were brought to their lengths at 0,0
  kStopped,       ///< a stop ended what was going on
  kNewSettings,   ///< a client has sent its settings
  kBeforeLine,    ///< a line comes after new settings, before the client has fallen silent
  kHalted,        ///< a stop came after a fault
  kErased,        ///< the stored position was erased
  kChainsDriven,  ///< chains were moved one by one, or tested
  kPulled,        ///< the motors are off, and the chains are no longer as they were left
};

/// Where the sled is. Works it out from the chains, keeps it through a power cut, and says it, or
/// why it is lost. Where the program is follows: see ProgramPlace.
class SledPlace {
 public:
  explicit SledPlace(Parts& parts) : parts_(parts) {}

  Whereabouts whereabouts() const;
  bool isKnown() const { return whereabouts() == Whereabouts::kFound; }

  /// Works out the place from the measured chains; all moves begin there. If the reason is one to
  /// say it and the chains are trusted, says it, and from now on the sled belongs there. Returns
  /// whether a sled can hang on these chains.
  bool search(Search why);
  /// All moves begin where the sled was found last, at the height that z has now.
  void standHere();
  /// Declares that the tool is at this z [mm].
  void declareZ(float z);

  /// At the start: takes over the stored position.
  void restore(const settings::Started& started);
  void sayUnset(bool has_defaults);
  /// From now on the chains are not trusted, nor is z unless the reason spares it; says why.
  void lose(settings::Doubt why);
  /// Takes over which axes' counts were proved wrong.
  void doubtCounts();
  /// Settings without which the sled cannot cross the sheet.
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
  static bool isSaid(Search why);
  void say() const;
  void sayNowhere();
  void sayLengths() const;
  void followPulledChains();
  FoundPlace byChains(float left, float right) const;

  Parts& parts_;
  Place sled_ = {0, 0, 0};  ///< where the tool was at the last search or call of now()
  int32_t shown_left_ = 0, shown_right_ = 0;  ///< set-points of `sled_` while it moves [counts]
  Place left_at_ = {0, 0, 0};                 ///< where the motors left the tool
  float moved_by_ = 0;                        ///< [mm]
  bool hangs_ = false;  ///< whether a sled can hang on the chains as last searched
};

}  // namespace machine
