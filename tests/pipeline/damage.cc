#include "tests/pipeline/damage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <stdexcept>

#include <hdf5.h>

namespace blocklift::pipeline::test {
namespace {

/// Reads and writes an HDF5 file, and closes it.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file)
      : id_(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)) {
    if (id_ < 0) throw std::runtime_error("cannot open " + file.string());
  }
  ~OpenFile() { H5Fclose(id_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  hid_t id() const { return id_; }

 private:
  hid_t id_;
};

/// An object that is held while a dataset is made anew; attributes move over by copying.
herr_t copy_attribute(hid_t from, const char* name, const H5A_info_t*, void* to) {
  const hid_t attribute = H5Aopen(from, name, H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
  std::vector<char> value(H5Tget_size(type));
  H5Aread(attribute, type, value.data());
  const hid_t copy =
      H5Acreate2(*static_cast<hid_t*>(to), name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(copy, type, value.data());
  H5Aclose(copy);
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, value.data());
  H5Sclose(space);
  H5Tclose(type);
  H5Aclose(attribute);
  return 0;
}

/// Puts another dataset with the same attributes in the place of one.
void replace(hid_t file, const std::string& dataset, hid_t type, const std::vector<hsize_t>& shape,
             const void* data) {
  const hid_t old = H5Dopen2(file, dataset.c_str(), H5P_DEFAULT);
  H5Ldelete(file, dataset.c_str(), H5P_DEFAULT);
  const hid_t space = shape.empty()
                          ? H5Screate(H5S_SCALAR)
                          : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  hid_t made =
      H5Dcreate2(file, dataset.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
  hsize_t index = 0;
  H5Aiterate2(old, H5_INDEX_NAME, H5_ITER_INC, &index, copy_attribute, &made);
  H5Dclose(made);
  H5Sclose(space);
  H5Dclose(old);
}

void replace_by_text(hid_t file, const std::string& dataset) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  const char* text = "something else";
  replace(file, dataset, type, {}, &text);
  H5Tclose(type);
}

}  // namespace

std::vector<std::string> datasets_of(const std::filesystem::path& file) {
  std::vector<std::string> names;
  const OpenFile open(file);
  const auto keep = [](hid_t, const char* name, const H5O_info_t* info, void* out) -> herr_t {
    if (info->type == H5O_TYPE_DATASET)
      static_cast<std::vector<std::string>*>(out)->push_back(std::string("/") + name);
    return 0;
  };
  H5Ovisit(open.id(), H5_INDEX_NAME, H5_ITER_INC, keep, &names);
  return names;
}

bool damage(const std::filesystem::path& file, const std::string& dataset, Damage way) {
  const OpenFile open(file);
  const hid_t set = H5Dopen2(open.id(), dataset.c_str(), H5P_DEFAULT);
  const hid_t type = H5Dget_type(set), space = H5Dget_space(set);
  const bool is_text = H5Tget_class(type) == H5T_STRING;
  const bool is_float = H5Tget_class(type) == H5T_FLOAT;
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  H5Tclose(type);
  H5Sclose(space);
  bool is_done = true;
  switch (way) {
    case Damage::removed:
      H5Ldelete(open.id(), dataset.c_str(), H5P_DEFAULT);
      break;
    case Damage::one_number: {
      const double one = 1;
      replace(open.id(), dataset, H5T_NATIVE_DOUBLE, {}, &one);
      break;
    }
    case Damage::text:
      replace_by_text(open.id(), dataset);
      break;
    case Damage::other_shape: {
      const std::vector<double> values(5 * (count + 1), 0.5);
      replace(open.id(), dataset, H5T_NATIVE_DOUBLE, {5, count + 1}, values.data());
      break;
    }
    case Damage::not_a_number: {
      is_done = is_float && !is_text && count > 0;
      if (!is_done) break;
      std::vector<double> values(count);
      H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values[count / 2] = NAN;
      H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      break;
    }
  }
  H5Dclose(set);
  return is_done;
}

void cut(const std::filesystem::path& file, double share) {
  const auto size = static_cast<double>(std::filesystem::file_size(file));
  std::filesystem::resize_file(file, static_cast<std::uintmax_t>(share * size));
}

void flip_bytes(const std::filesystem::path& file, double place, int count) {
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(file));
  auto at = static_cast<std::streamoff>(place * static_cast<double>(size));
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  for (int i = 0; i < count && at < size; ++i, ++at) {
    stream.seekg(at);
    const int byte = stream.get();
    stream.seekp(at);
    stream.put(static_cast<char>(~byte));
  }
}

}  // namespace blocklift::pipeline::test
