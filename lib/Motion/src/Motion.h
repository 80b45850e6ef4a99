// The library's front door: from moves and feeds to set-points, and from a set-point to the duty of
// its motor.
#pragma once

#include "axis_loop.h"
#include "lift.h"
#include "mover.h"
#include "playback.h"
#include "slip_watch.h"
#include "watch.h"
#include "yield.h"
