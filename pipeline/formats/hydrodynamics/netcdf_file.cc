#include "pipeline/formats/hydrodynamics/netcdf_file.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

#include "pipeline/formats/hdf5_handle.h"

namespace blocklift::pipeline {
namespace {

/// Names of the dimensions of a variable: NetCDF-4 keeps references to them in an attribute.
std::vector<std::string> read_dimensions(const std::filesystem::path& path,
                                         const std::string& name) {
  using hdf5::Handle;
  const hdf5::QuietErrors quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Handle set(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  const auto rank = static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get())));
  if (rank == 0) return {};
  // A variable of its own dimension has no list.
  if (H5Aexists(set.get(), "DIMENSION_LIST") <= 0) return {name};
  const Handle attribute(H5Aopen(set.get(), "DIMENSION_LIST", H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle list_space(H5Aget_space(attribute.get()), H5Sclose);
  std::vector<hvl_t> lists(rank, hvl_t{0, nullptr});
  if (H5Sget_simple_extent_npoints(list_space.get()) != static_cast<hssize_t>(rank) ||
      H5Aread(attribute.get(), type.get(), lists.data()) < 0) {
    throw ResultsError(path.string() + ": the dimensions of \"" + name + "\" cannot be read");
  }
  std::vector<std::string> names;
  for (hvl_t& list : lists) {
    std::array<char, 256> text{};
    if (list.len > 0) {
      const Handle target(H5Rdereference2(set.get(), H5P_DEFAULT, H5R_OBJECT, list.p), H5Oclose);
      H5Iget_name(target.get(), text.data(), text.size());
    }
    names.emplace_back(text[0] == '/' ? text.data() + 1 : text.data());
  }
  H5Dvlen_reclaim(type.get(), list_space.get(), H5P_DEFAULT, lists.data());
  return names;
}

/// The length of the last dimension of texts that are kept as characters; 1 for strings.
std::size_t character_count(const std::filesystem::path& path, const std::string& name) {
  using hdf5::Handle;
  const hdf5::QuietErrors quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Handle set(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  const bool characters = H5Tis_variable_str(type.get()) == 0 && H5Tget_size(type.get()) == 1;
  if (!characters || rank < 1) return 1;
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
  return static_cast<std::size_t>(extents.back());
}

/// Complex numbers as h5py and h5netcdf write them, compounds of a real part r and an imaginary
/// part i: both along one more dimension, the last. None: the variable holds something else.
std::optional<Array<double>> read_complex(const std::filesystem::path& path,
                                          const std::string& name) {
  using hdf5::Handle;
  const hdf5::QuietErrors quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Handle set(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  if (H5Tget_class(type.get()) != H5T_COMPOUND || H5Tget_nmembers(type.get()) != 2) return {};
  const Handle pair(H5Tcreate(H5T_COMPOUND, 2 * sizeof(double)), H5Tclose);
  std::size_t offset = 0;
  for (const char* const part : {"r", "i"}) {
    const int member = H5Tget_member_index(type.get(), part);
    if (member < 0) return {};
    if (H5Tget_member_class(type.get(), static_cast<unsigned>(member)) != H5T_FLOAT) return {};
    H5Tinsert(pair.get(), part, offset, H5T_NATIVE_DOUBLE);
    offset += sizeof(double);
  }
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  std::vector<hsize_t> extents(
      static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
  H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
  Array<double> array;
  array.shape.assign(extents.begin(), extents.end());
  array.shape.push_back(2);
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  array.values.resize(2 * static_cast<std::size_t>(std::max<hssize_t>(0, count)));
  if (!array.values.empty() &&
      H5Dread(set.get(), pair.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) < 0) {
    throw ResultsError(path.string() + ": the complex numbers of \"" + name + "\" cannot be read");
  }
  return array;
}

/// NetCDF-4.
class Hdf5Netcdf : public NetcdfFile::Source {
 public:
  explicit Hdf5Netcdf(const std::filesystem::path& path) : path_(path), reader_(path) {}

  bool has(const std::string& name) const override { return reader_.has(name); }

  bool holds_texts(const std::string& name) const override {
    using hdf5::Handle;
    const hdf5::QuietErrors quiet;
    const Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    const Handle set(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    return H5Tget_class(type.get()) == H5T_STRING;
  }

  NetcdfVariable read(const std::string& name) const override {
    std::optional<Array<double>> complex = read_complex(path_, name);
    const bool is_complex = complex.has_value();
    NetcdfVariable result{{}, is_complex ? std::move(*complex) : reader_.read(name)};
    result.dimensions = read_dimensions(path_, name);
    if (is_complex) result.dimensions.emplace_back("complex");
    return result;
  }

  std::vector<std::string> read_texts(const std::string& name) const override {
    std::vector<std::string> texts = reader_.read_texts(name);
    const std::size_t length = character_count(path_, name);
    if (length <= 1) return texts;
    std::string characters;
    for (const std::string& text : texts) characters += text.empty() ? " " : text;
    return texts_of_characters(characters, length);
  }

 private:
  std::filesystem::path path_;
  ResultsReader reader_;
};

bool is_classic(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::array<char, 3> magic{};
  stream.read(magic.data(), magic.size());
  return stream && magic == std::array{'C', 'D', 'F'};
}

}  // namespace

double NetcdfVariable::at(const std::map<std::string, std::size_t>& place) const {
  std::size_t index = 0;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    const auto named = place.find(dimensions[d]);
    index = index * array.shape[d] + (named == place.end() ? 0 : named->second);
  }
  return array.values[index];
}

std::vector<std::string> texts_of_characters(const std::string& characters, std::size_t length) {
  std::vector<std::string> texts;
  for (std::size_t at = 0; length > 0 && at + length <= characters.size(); at += length) {
    std::string text = characters.substr(at, length);
    text.erase(text.find_last_not_of(std::string(" \0", 2)) + 1);
    texts.push_back(std::move(text));
  }
  return texts;
}

NetcdfFile::NetcdfFile(const std::filesystem::path& path) {
  if (is_classic(path)) {
    source_ = open_classic_netcdf(path);
  } else {
    source_ = std::make_unique<const Hdf5Netcdf>(path);
  }
}

NetcdfFile::~NetcdfFile() = default;

bool NetcdfFile::has(const std::string& name) const { return source_->has(name); }

bool NetcdfFile::holds_texts(const std::string& name) const { return source_->holds_texts(name); }

NetcdfVariable NetcdfFile::read(const std::string& name) const { return source_->read(name); }

std::vector<std::string> NetcdfFile::read_texts(const std::string& name) const {
  return source_->read_texts(name);
}

}  // namespace blocklift::pipeline
