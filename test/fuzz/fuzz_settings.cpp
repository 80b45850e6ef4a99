// Fuzz target: an EEPROM with any bytes in it at power-on, then lines that begin with a dollar.
//
// The input: which image, how many patches, each {address, address, length, bytes}, then the lines.
#include <cstddef>

#include "settings_host/published_image.h"
#include "world.h"

namespace {

/// Reads an input from its front; zeros behind its end.
struct Front {
  const uint8_t* at;
  std::size_t left;

  uint8_t take() {
    if (left == 0) return 0;
    --left;
    return *at++;
  }
};

std::vector<uint8_t> bytesOf(const Eeprom& eeprom) {
  std::vector<uint8_t> bytes;
  for (uint16_t at = 0; at < eeprom.size(); ++at) bytes.push_back(eeprom.read(at));
  return bytes;
}

std::vector<uint8_t> imageBy(uint8_t choice) {
  switch (choice % 5) {
    case 0:
      return ownImage();
    case 1:
    case 2:
      return bytesOf(publishedImage(choice % 5 == 1));
    case 3:
      return std::vector<uint8_t>(4096, 0);
    default:
      return std::vector<uint8_t>(4096, 0xff);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  Front front = {data, size};
  Story story;
  story.step_ms = 10;
  story.eeprom = imageBy(front.take());
  for (int patches = front.take() % 8; patches > 0; --patches) {
    std::size_t address = front.take();
    address = (address << 8 | front.take()) % story.eeprom.size();
    for (int length = front.take() % 64; length > 0; --length)
      story.eeprom[address++ % story.eeprom.size()] = front.take();
  }
  for (bool starts = true; front.left != 0;) {
    const char character = char(front.take());
    if (starts && character > 7) story.sent += '$';
    starts = character == '\n';
    story.sent += character;
  }
  live(story);
  return 0;
}
