// Front door of the laws of motion: from moves and feeds to set-points of all axes.
#pragma once

#include "mover.h"
