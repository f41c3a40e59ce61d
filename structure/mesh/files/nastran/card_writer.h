#pragma once

#include <array>
#include <string>
#include <vector>

namespace blocklift::structure {

/// One field of a card that is written: a whole number, a real, a word, or blank.
class CardField {
 public:
  CardField() = default;
  CardField(long value) : text_(std::to_string(value)) {}
  CardField(int value) : text_(std::to_string(value)) {}
  CardField(double value);
  CardField(const char* word) : text_(word) {}
  CardField(std::string word) : text_(std::move(word)) {}
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Components as a card has them: "135".
std::string digits(const std::array<bool, 6>& components);

/// Cards as text: small fields where all values are short, else large ones.
class CardWriter {
 public:
  void line(const std::string& text) { text_ += text + '\n'; }
  void card(const std::string& name, std::vector<CardField> fields);
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace blocklift::structure
