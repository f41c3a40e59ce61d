#include "structure/mesh/files/nastran/card_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace blocklift::structure {

namespace {

/// With a point, the exponent without its letter: 1.5-3.
std::string as_real(const std::string& text) {
  const auto letter = text.find('e');
  std::string mantissa = text.substr(0, letter);
  if (mantissa.find('.') == std::string::npos) mantissa += '.';
  if (letter == std::string::npos) return mantissa;
  const int exponent = std::stoi(text.substr(letter + 1));
  return mantissa + fmt::format("{:+d}", exponent);
}

}  // namespace

CardField::CardField(double value) {
  if (value == 0) {
    text_ = "0.";
    return;
  }
  constexpr std::size_t widest = 16;
  std::array<char, 40> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text_ = as_real(std::string(buffer.data(), end));
  for (int digits = 12; text_.size() > widest; --digits)
    text_ = as_real(fmt::format("{:.{}e}", value, digits));
}

void CardWriter::card(const std::string& name, std::vector<CardField> fields) {
  while (!fields.empty() && fields.back().text().empty()) fields.pop_back();
  const bool is_small = std::all_of(fields.begin(), fields.end(), [](const CardField& field) {
    return field.text().size() <= 8;
  });
  const std::size_t width = is_small ? 8 : 16, count = is_small ? 8 : 4;
  std::string line = fmt::format("{:<8}", is_small ? name : name + '*');
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0 && i % count == 0) {
      text_ += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
      line = is_small ? "+       " : "*       ";
    }
    line += fmt::format("{:<{}}", fields[i].text(), width);
  }
  text_ += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

std::string digits(const std::array<bool, 6>& components) {
  std::string text;
  for (std::size_t i = 0; i < 6; ++i)
    if (components[i]) text += static_cast<char>('1' + i);
  return text;
}

}  // namespace blocklift::structure
