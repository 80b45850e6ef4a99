// The refusals, by name.
#include "motion_door.h"

#include "settings_table.h"

namespace machine {

bool MotionDoor::goesOnFromHere() {
  if (!(place_.movedBy() > 0)) return true;
  return answers_.refuseMotion(FLASH("the sled moved "), place_.movedBy(),
                               FLASH(" mm while its motors were off: bring it back, or begin again "
                                     "from where it is"));
}

bool MotionDoor::doChainsFollow() {
  if (values_.at(kMainPositionP) > 0 || axes_.isSimulated()) return true;
  return answers_.refuseMotion(
      FLASH("the chains do not follow while $21 is 0: connect your client, or send $21=1300"));
}

bool MotionDoor::doesZFollow() {
  if (values_.at(kZPositionP) > 0 || axes_.isSimulated()) return true;
  return answers_.refuseMotion(
      FLASH("z does not follow while $29 is 0: connect your client, or send $29=1300"));
}

}  // namespace machine
