// The machine on the stage, through all power cuts of its dialogue.
#pragma once

#include "machine/machine.h"
#include "stage.h"

/// Plays the stage's dialogue to its end; throws Failure.
void live(Stage& stage, const machine::BoardName& board = {2, ""});
