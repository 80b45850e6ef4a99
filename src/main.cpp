// Answers questions about one machine, as yet without motors: `L x y` by the chain lengths for a
// place, `P left right` by the place for chain lengths; all in mm, one question a line.

#include <Arduino.h>
#include <Kinematics.h>

#include "default_machine.h"
#include "line.h"
#include "question.h"
#include "board/shield.h"

using namespace kinematics;

namespace {

const uint32_t kBaud = 57600;  // the speed that GroundControl and WebControl open the port with
const uint8_t kDigits = 3;

Machine<float> machine;
Line line;

void printPair(const __FlashStringHelper* word, float first, float second) {
  Serial.print(word);
  Serial.print(first, kDigits);
  Serial.print(' ');
  Serial.println(second, kDigits);
}

void printAnswer(Found found, const __FlashStringHelper* word, float first, float second) {
  switch (found) {
    case Found::kYes:
      return printPair(word, first, second);
    case Found::kOutOfReach:
      Serial.println(F("out of reach"));
      return;
    case Found::kTooManyTries:
      Serial.println(F("too many tries"));
  }
}

void answer(const Question& question) {
  if (question.kind == Question::kLengths) {
    const PaidOut<float> paid = inverse(machine, Point<float>{question.first, question.second});
    printAnswer(paid.found, F("lengths "), paid.chains.left, paid.chains.right);
  } else if (question.kind == Question::kPlace) {
    const Place<float> place = forward(machine, Chains<float>{question.first, question.second});
    printAnswer(place.found, F("place "), place.sled.x, place.sled.y);
  } else {
    Serial.println(F("error: ask L x y or P left right, in mm, below 100000"));
  }
}

}  // namespace

void setup() {
  Serial.begin(kBaud);
  machine = defaultMachine();
  const board::Shield* shield = detectShield();
  if (shield) {
    Serial.print(F("PCB v1."));
    Serial.print(shield->version);
    Serial.println(F(" Detected"));
  } else {
    Serial.println(F("error: no motor shield has these straps on pins 22 to 27"));
  }
  Serial.println(F("Plumb, firmware for the Maslow CNC"));
}

void loop() {
  while (Serial.available() > 0) {
    if (!line.add(char(Serial.read()))) continue;
    if (line.tooLong())
      Serial.println(F("error: a line has at most 40 characters"));
    else
      answer(readQuestion(line.text()));
    line.clear();
  }
}
