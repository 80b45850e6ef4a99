// How inputs are changed.
#include "mutator.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

const std::size_t kLongest = 2000;

}  // namespace

Corpus readCorpus(const std::string& folder) {
  std::vector<std::filesystem::path> names;
  for (const auto& file : std::filesystem::directory_iterator(folder)) names.push_back(file.path());
  std::sort(names.begin(), names.end());
  Corpus corpus;
  for (const auto& name : names) {
    std::ifstream file(name, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return corpus;
}

Input Mutator::next(const Corpus& corpus) {
  // Half of the time the input is among the newest, which reach new edges most often.
  const std::size_t newest = std::min<std::size_t>(corpus.size(), 20);
  const std::size_t at = below(2) == 0 ? corpus.size() - 1 - below(newest) : below(corpus.size());
  Input input = corpus[at];
  for (std::size_t left = 1 + below(6); left != 0; --left) change(input, corpus);
  if (input.size() > kLongest) input.resize(kLongest);
  return input;
}

void Mutator::change(Input& input, const Corpus& corpus) {
  if (input.empty()) input.push_back(uint8_t(below(256)));
  const std::size_t at = below(input.size());
  switch (below(9)) {
    case 0:
      input[at] = uint8_t(input[at] ^ (1 << below(8)));
      break;
    case 1:
      input[at] = uint8_t(below(256));
      break;
    case 2:
      input[at] = uint8_t("0123456789.-+ E\n"[below(16)]);
      break;
    case 3:
      input.erase(
          input.begin() + long(at),
          input.begin() + long(at + 1 + below(std::min<std::size_t>(8, input.size() - at))));
      break;
    case 4:
    case 5:
      insert(input, wordOf(corpus[below(corpus.size())]));
      break;
    case 6:
      insert(input, std::to_string(double(int(below(40001)) - 20000) / double(1 + below(100))));
      break;
    case 7:
      splice(input, corpus[below(corpus.size())]);
      break;
    default:
      moveLine(input);
  }
}

/// A word of an input with the space or line end behind it, or what acts on the board.
std::string Mutator::wordOf(const Input& other) {
  if (other.empty() || below(8) == 0) return std::string(1, char(1 + below(7)));
  const auto isEnd = [](uint8_t byte) { return byte == ' ' || byte == '\n'; };
  const auto start = other.begin() + long(below(other.size()));
  const auto end = std::find_if(start, other.end(), isEnd);
  return std::string(start, end == other.end() ? end : end + 1);
}

void Mutator::insert(Input& input, const std::string& text) {
  input.insert(input.begin() + long(below(input.size() + 1)), text.begin(), text.end());
}

void Mutator::splice(Input& input, const Input& other) {
  const std::size_t from = below(other.size());
  const std::size_t length = below(std::min<std::size_t>(other.size() - from, 200) + 1);
  const Input part(other.begin() + long(from), other.begin() + long(from + length));
  input.insert(input.begin() + long(below(input.size() + 1)), part.begin(), part.end());
}

void Mutator::moveLine(Input& input) {
  const auto start = input.begin() + long(below(input.size()));
  const auto end = std::find(start, input.end(), uint8_t('\n'));
  const Input line(start, end);
  if (below(2) == 0) input.erase(start, end);
  input.insert(input.begin() + long(below(input.size() + 1)), line.begin(), line.end());
}
