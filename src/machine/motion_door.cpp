// The refusals, by name.
#include "motion_door.h"

#include "settings_table.h"

namespace machine {

bool MotionDoor::goesOnFromHere() {
  if (!(place_.movedBy() > 0)) return true;
  return base_.answers.refuseMotion(
      FLASH("the sled moved "), place_.movedBy(),
      FLASH(" mm while its motors were off: bring it back, or begin again "
            "from where it is"));
}

bool MotionDoor::doChainsFollow() {
  if (base_.values.at(kMainPositionP) > 0 || base_.axes.isSimulated()) return true;
  return base_.answers.refuseMotion(
      FLASH("the chains do not follow while $21 is 0: connect your client, or send $21=1300"));
}

bool MotionDoor::doesZFollow() {
  if (base_.values.at(kZPositionP) > 0 || base_.axes.isSimulated()) return true;
  return base_.answers.refuseMotion(
      FLASH("z does not follow while $29 is 0: connect your client, or send $29=1300"));
}

}  // namespace machine
