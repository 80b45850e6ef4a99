// Where the flashed program keeps what a test looks at: places in the machine, in the section
// .places of this object file. It is compiled with -fno-access-control, for the same processor.
#include "machine/machine.h"

using machine::Machine;
using machine::TickedAxis;

#define PLACE(member) uint16_t(__builtin_offsetof(Machine, member))
#define PLACE_OF_AXIS(member) PLACE(parts_.axes.axis_[0].member)

extern "C" const uint16_t kPlaces[] __attribute__((section(".places"), used)) = {
    PLACE(parts_.course.state_),         PLACE(parts_.keeper.lost_),
    uint16_t(sizeof(TickedAxis)),        PLACE_OF_AXIS(mode_),
    PLACE_OF_AXIS(set_point_),           PLACE_OF_AXIS(counts_),
    PLACE_OF_AXIS(scale_.mm_per_count_),
};
