// New inputs from old inputs: bytes, lines and words of the protocol changed, moved and mixed.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

using Input = std::vector<uint8_t>;
using Corpus = std::vector<Input>;

/// The files of a folder, by name.
Corpus readCorpus(const std::string& folder);

/// Draws inputs; the same seed draws the same inputs.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  /// An input of the corpus, changed in a few places.
  Input next(const Corpus& corpus);

 private:
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random_() % limit; }
  void change(Input& input, const Corpus& corpus);
  std::string wordOf(const Input& other);
  void insert(Input& input, const std::string& text);
  void splice(Input& input, const Input& other);
  void moveLine(Input& input);

  std::mt19937 random_;
};
