// Front door: from characters on the wire to pieces of G-code with their numbers. It moves nothing.
#pragma once

#include "arc_centre.h"
#include "drilling.h"
#include "input.h"
#include "modal.h"
#include "pieces.h"
#include "words.h"
#include "work_offsets.h"
