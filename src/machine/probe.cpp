// G38.2: z goes down until the probe touches, and is zero there.
#include "machine.h"

namespace machine {
namespace {

// The clients send F1 in the units of the moment; the published firmware ignores it as well.
const float kProbeFeed = 60;  // [mm/min]

}  // namespace

bool Machine::probe(float target) {
  if (values_.at(kZMotor) == 0) return refuseMotion(FLASH("a probe needs a z motor ($16)"));
  if (!(float(fabs(target)) <= kMostTravel)) return refuseMotion(FLASH("no z axis is that long"));
  if (!drain()) return false;
  if (aux_.probeTouches())
    return refuseMotion(FLASH("the probe touches already: lift z, or look for a short"));
  out_.line(FLASH("probing for z axis zero"));
  out_ << FLASH("max depth ");
  out_.fixed(inUnits(target), 2).line(modal_.inches ? FLASH(" in.") : FLASH(" mm."));
  const float feed = mostZFeed() < kProbeFeed ? mostZFeed() : kProbeFeed;
  out_ << FLASH("feedrate ");
  out_.fixed(inUnits(feed), 2).line(modal_.inches ? FLASH(" in per min.") : FLASH(" mm per min."));
  const bool touched = moveAxis(kZAxis, target, feed, true);
  if (stopping_) return false;
  if (!touched) {
    standHere();
    return refuseMotion(FLASH("probe did not connect"));
  }
  declareZ(axes_.length(kZAxis));
  out_.line(FLASH("z axis zeroed"));
  return true;
}

}  // namespace machine
