// Chains paid out and wound in, and z against the probe.
#include "single_axis.h"

namespace machine {
namespace {

const float kAxisFeed = 800;  // [mm/min] unless a command says otherwise
// The clients send F1 in the units in force; the published firmware ignores it too.
const float kProbeFeed = 60;  // [mm/min]
const char kChainLetters[] = {'L', 'R'};

}  // namespace

bool SingleAxis::move(Axis axis, float goal, float feed, Until until) {
  if (!waiting_.drain() || !motors_.wake()) return false;
  planner_.standAt(axes_.setPoint());
  planner_.addAxis(axis, goal, feed / 60);
  bool ended = false;
  // A stop brakes along the path, so this goes on until the axis stands still.
  while (waiting_.isMoving() && !ended) {
    ended = until != Until::kGoal && aux_.probeTouches() == (until == Until::kTouch);
    waiting_.pass();
  }
  if (ended) {
    const Place& at = program_.aim();
    probed_ = {at.x, at.y, axes_.length(axis)};
    planner_.forget();
    axes_.dropSetPoints();
  }
  waiting_.settle();
  planner_.standAt(axes_.setPoint());
  return !waiting_.isStopping() && (ended || until == Until::kGoal);
}

bool SingleAxis::measureOut(Axis axis) {
  if (!isLength(values_.at(kExtendLength)))
    return answers_.refuseMotion(FLASH("no chain is that long ($11)"));
  if (!door_.doChainsFollow()) return false;
  out_.line(axis == kLeftAxis ? FLASH("Measuring out left chain")
                              : FLASH("Measuring out right chain"));
  const bool completed = move(axis, values_.at(kExtendLength), 0.9f * values_.at(kGreatestFeed));
  axes_.release(axis);
  place_.search(Search::kChainsDriven);
  if (!completed) return false;
  out_.fixed(axes_.length(axis), 2).line(FLASH("mm"));
  return true;
}

bool SingleAxis::mayHang(float left, float right) {
  const float kFarOff = 500;  // [mm] no sled is so far beyond the sheet while it is measured
  const FoundPlace found = geometry_.forward(left, right, {0, 0});
  if (!found.found || !(geometry_.sheet().distanceTo(found.at) > kFarOff)) return true;
  answers_.beginError(grbl::kTravel);
  out_ << FLASH("such chains put the sled at X");
  out_.fixed(found.at.x, 0) << FLASH(" Y");
  out_.fixed(found.at.y, 0)
      .line(FLASH(", far off the sheet: measure again, or check the settings"));
  return false;
}

bool SingleAxis::setChains(float left, float right) {
  if (!isLength(left) || !isLength(right)) return answers_.refuseMotion(tooLongForChains());
  axes_.declare(kLeftAxis, left);
  axes_.declare(kRightAxis, right);
  out_ << FLASH("Left: ");
  out_.fixed(axes_.length(kLeftAxis), 2).line(FLASH("mm"));
  out_ << FLASH("Right: ");
  out_.fixed(axes_.length(kRightAxis), 2).line(FLASH("mm"));
  place_.trustChains();
  place_.search(Search::kDeclared);
  return true;
}

bool SingleAxis::setChainsToMarks() {
  const float length = values_.at(kExtendLength);
  if (!setChains(length, length)) return false;
  out_.line(FLASH("Message: The machine chains have been manually re-calibrated."));
  return true;
}

bool SingleAxis::moveChains(const gcode::Words& words) {
  if (!door_.goesOnFromHere() || !door_.doChainsFollow()) return false;
  const float feed = words.value('F') > 0 ? words.value('F') : kAxisFeed;
  float goals[2];
  for (uint8_t i = 0; i < 2; ++i) {
    const float is = axes_.target(Axis(i)), given = words.value(kChainLetters[i]);
    // A chain without a word stays.
    goals[i] = !words.has(kChainLetters[i]) ? is : modal_.relative ? is + given : given;
    if (!isLength(goals[i])) return answers_.refuseMotion(tooLongForChains());
  }
  bool completed = true;
  for (uint8_t i = 0; i < 2; ++i)
    if (goals[i] != axes_.target(Axis(i))) completed = completed && move(Axis(i), goals[i], feed);
  place_.search(Search::kChainsDriven);
  return completed;
}

bool SingleAxis::goHome() {
  if (!place_.isKnown()) return answers_.refuseMotion(place_.whatIsLost());
  if (!door_.goesOnFromHere() || !door_.doChainsFollow()) return false;
  const motion::Lengths<float> lengths = geometry_.inverse({0, 0});
  if (!lengths.reachable)
    return answers_.refuseMotion(FLASH("with these settings no sled can hang at 0,0"));
  const bool completed =
      move(kLeftAxis, lengths.left, kAxisFeed) && move(kRightAxis, lengths.right, kAxisFeed);
  if (completed) place_.search(Search::kCentred);
  return completed;
}

bool SingleAxis::measureChain(bool left) {
  out_ << FLASH("[Measure: ");
  out_.fixed(axes_.length(left ? kLeftAxis : kRightAxis), 2).line(FLASH("]"));
  return true;
}

void SingleAxis::sayProbing(float target, float feed) {
  out_.line(FLASH("probing for z axis zero"));
  out_ << FLASH("max depth ");
  out_.fixed(modal_.fromMm(target), 2).line(modal_.inches ? FLASH(" in.") : FLASH(" mm."));
  out_ << FLASH("feedrate ");
  out_.fixed(modal_.fromMm(feed), 2);
  out_.line(modal_.inches ? FLASH(" in per min.") : FLASH(" mm per min."));
}

bool SingleAxis::probe(float target, bool until_touch, bool must) {
  if (!z_.hasMotor()) return answers_.refuseMotion(FLASH("a probe needs a z motor ($16)"));
  if (!door_.goesOnFromHere() || !door_.doesZFollow()) return false;
  if (!ZAxis::reaches(target)) return answers_.refuseMotion(tooLongForZ());
  if (!waiting_.drain()) return false;
  has_probed_ = false;
  if (aux_.probeTouches() == until_touch)
    return answers_.refuseMotion(
        until_touch ? FLASH("the probe touches already: lift z, or look for a short")
                    : FLASH("the probe touches nothing already"));
  const float feed = z_.mostFeed() < kProbeFeed ? z_.mostFeed() : kProbeFeed;
  sayProbing(target, feed);
  has_probed_ = move(kZAxis, target, feed, until_touch ? Until::kTouch : Until::kLetGo);
  if (waiting_.isStopping()) return false;
  if (has_probed_ && (!out_.speaksGrbl() || !place_.trustsZ())) {
    // The axis ran on for a moment.
    z_.declare(axes_.length(kZAxis) - probed_.z);
    probed_.z = 0;
    out_.line(FLASH("z axis zeroed"));
    return true;
  }
  place_.standHere();
  return has_probed_ || !must || answers_.refuseMotion(FLASH("probe did not connect"));
}

}  // namespace machine
