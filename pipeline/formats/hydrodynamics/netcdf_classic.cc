#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "pipeline/formats/hydrodynamics/netcdf_file.h"

namespace blocklift::pipeline {
namespace {

/// The first version of the specification; the second has longer offsets, the fifth longer counts.
constexpr unsigned char longer_offsets = 2, longer_counts = 5;
constexpr std::uint32_t dimension_tag = 10, variable_tag = 11, attribute_tag = 12;

enum class NetcdfType : std::uint32_t {
  byte = 1,
  character,
  short_integer,
  integer,
  single,
  real,
  unsigned_byte,
  unsigned_short,
  unsigned_integer,
  long_integer,
  unsigned_long
};

std::size_t size_of(NetcdfType type) {
  static constexpr std::array<std::size_t, 12> sizes = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  return sizes[static_cast<std::size_t>(type)];
}

/// Reads a classic file that is whole in memory; nothing is read beyond its end.
class ClassicFile : public NetcdfFile::Source {
 public:
  explicit ClassicFile(const std::filesystem::path& path) : path_(path) {
    std::ifstream stream(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    version_ = bytes_.size() < 4 ? 0 : static_cast<unsigned char>(bytes_[3]);
    if (bytes_.compare(0, 3, "CDF") != 0 ||
        (version_ != 1 && version_ != longer_offsets && version_ != longer_counts)) {
      fail("is no NetCDF of the classic formats");
    }
    place_ = 4;
    records_ = count();
    read_dimensions();
    skip_attributes();
    read_variables();
  }

  bool has(const std::string& name) const override { return variables_.contains(name); }

  bool holds_texts(const std::string& name) const override {
    return find(name).type == NetcdfType::character;
  }

  NetcdfVariable read(const std::string& name) const override {
    const Entry& entry = find(name);
    if (entry.type == NetcdfType::character) fail("\"" + name + "\" holds text, no numbers");
    NetcdfVariable variable;
    for (const std::size_t dimension : entry.dimensions) {
      variable.dimensions.push_back(dimensions_[dimension].name);
      variable.array.shape.push_back(extent(dimension));
    }
    const std::string raw = data(name, entry);
    const std::size_t size = size_of(entry.type);
    for (std::size_t at = 0; at < raw.size(); at += size) {
      variable.array.values.push_back(number(entry.type, raw.substr(at, size)));
    }
    return variable;
  }

  std::vector<std::string> read_texts(const std::string& name) const override {
    const Entry& entry = find(name);
    if (entry.type != NetcdfType::character) fail("\"" + name + "\" holds no text");
    const std::string raw = data(name, entry);
    return texts_of_characters(raw, entry.dimensions.empty() ? 1 : extent(entry.dimensions.back()));
  }

 private:
  struct Dimension {
    std::string name;
    std::size_t length = 0;  ///< 0: as many as there are records
  };
  struct Entry {
    std::vector<std::size_t> dimensions;
    NetcdfType type = NetcdfType::byte;
    std::size_t begin = 0;
    bool in_records = false;
    std::size_t size = 0;  ///< bytes, of one record where it is kept in records; without padding
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw ResultsError(path_.string() + ": " + what);
  }

  std::uint64_t unsigned_of(std::size_t size) {
    if (size > bytes_.size() - std::min(place_, bytes_.size())) fail("is cut off");
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size; ++k) {
      value = value << 8 | static_cast<unsigned char>(bytes_[place_ + k]);
    }
    place_ += size;
    return value;
  }
  std::uint32_t word() { return static_cast<std::uint32_t>(unsigned_of(4)); }
  /// A number of things, which cannot be more than the file has bytes.
  std::size_t count() {
    const std::uint64_t value = unsigned_of(version_ == longer_counts ? 8 : 4);
    if (value > bytes_.size()) fail("has a count that its length does not allow");
    return static_cast<std::size_t>(value);
  }
  void skip_padding() { place_ = (place_ + 3) / 4 * 4; }
  std::string name() {
    const std::size_t length = count();
    if (length > bytes_.size() - std::min(place_, bytes_.size())) fail("is cut off");
    std::string text = bytes_.substr(place_, length);
    place_ += length;
    skip_padding();
    return text;
  }
  /// The length of a list, which is absent or begins with its tag.
  std::size_t list(std::uint32_t tag) {
    const std::uint32_t found = word();
    const std::size_t length = count();
    if (found != tag && (found != 0 || length != 0)) fail("has a damaged header");
    return length;
  }
  NetcdfType type() {
    const std::uint32_t value = word();
    if (value < 1 || value > static_cast<std::uint32_t>(NetcdfType::unsigned_long)) {
      fail(fmt::format("has values of the unknown type {}", value));
    }
    return static_cast<NetcdfType>(value);
  }

  void read_dimensions() {
    const std::size_t length = list(dimension_tag);
    for (std::size_t k = 0; k < length; ++k) {
      std::string text = name();
      dimensions_.push_back({std::move(text), count()});
    }
  }

  void skip_attributes() {
    const std::size_t length = list(attribute_tag);
    for (std::size_t k = 0; k < length; ++k) {
      name();
      const std::size_t size = size_of(type());
      place_ += size * count();
      skip_padding();
    }
  }

  void read_variables() {
    const std::size_t length = list(variable_tag);
    std::size_t in_records = 0;
    for (std::size_t k = 0; k < length; ++k) {
      const std::string text = name();
      Entry entry;
      const std::size_t rank = count();
      for (std::size_t d = 0; d < rank; ++d) {
        entry.dimensions.push_back(count());
        if (entry.dimensions.back() >= dimensions_.size()) fail("has a damaged header");
      }
      skip_attributes();
      entry.type = type();
      unsigned_of(version_ == longer_counts ? 8 : 4);  // its size, which follows from the shape
      entry.begin = static_cast<std::size_t>(unsigned_of(version_ == 1 ? 4 : 8));
      entry.in_records = rank > 0 && dimensions_[entry.dimensions[0]].length == 0;
      entry.size = size_of(entry.type);
      for (std::size_t d = entry.in_records ? 1 : 0; d < rank; ++d) {
        const std::size_t extent = dimensions_[entry.dimensions[d]].length;
        if (extent == 0) fail("\"" + text + "\" has records within records");
        if (entry.size > bytes_.size() / extent) fail("\"" + text + "\" is cut off");
        entry.size *= extent;
      }
      in_records += entry.in_records ? 1 : 0;
      variables_.emplace(text, std::move(entry));
    }
    for (const auto& [text, entry] : variables_) {
      if (!entry.in_records) continue;
      // The records of a single variable lie without gaps.
      record_size_ += in_records == 1 ? entry.size : (entry.size + 3) / 4 * 4;
    }
  }

  std::size_t extent(std::size_t dimension) const {
    const std::size_t length = dimensions_[dimension].length;
    return length == 0 ? records_ : length;
  }

  const Entry& find(const std::string& name) const {
    const auto found = variables_.find(name);
    if (found == variables_.end()) fail("\"" + name + "\": is not in the file");
    return found->second;
  }

  std::string data(const std::string& name, const Entry& entry) const {
    std::string raw;
    const std::size_t pieces = entry.in_records ? records_ : 1;
    for (std::size_t k = 0; k < pieces; ++k) {
      const std::size_t at = entry.begin + k * record_size_;
      if (at > bytes_.size() || entry.size > bytes_.size() - at) {
        fail("\"" + name + "\" is cut off");
      }
      raw.append(bytes_, at, entry.size);
    }
    return raw;
  }

  /// Of bytes that begin with the highest.
  static double number(NetcdfType type, const std::string& raw) {
    std::uint64_t bits = 0;
    for (const char byte : raw) bits = bits << 8 | static_cast<unsigned char>(byte);
    switch (type) {
      case NetcdfType::byte:
        return static_cast<std::int8_t>(bits);
      case NetcdfType::short_integer:
        return static_cast<std::int16_t>(bits);
      case NetcdfType::integer:
        return static_cast<std::int32_t>(bits);
      case NetcdfType::long_integer:
        return static_cast<double>(static_cast<std::int64_t>(bits));
      case NetcdfType::single:
        return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
      case NetcdfType::real:
        return std::bit_cast<double>(bits);
      default:
        return static_cast<double>(bits);
    }
  }

  std::filesystem::path path_;
  std::string bytes_;
  std::size_t place_ = 0;
  unsigned char version_ = 0;
  std::size_t records_ = 0, record_size_ = 0;
  std::vector<Dimension> dimensions_;
  std::map<std::string, Entry> variables_;
};

}  // namespace

std::unique_ptr<const NetcdfFile::Source> open_classic_netcdf(const std::filesystem::path& path) {
  return std::make_unique<const ClassicFile>(path);
}

}  // namespace blocklift::pipeline
