// Hydrodynamic databases in HDF5: read, or refused with a HydrodynamicFileError; what is accepted
// is sound. The input is a list of edits of a sound file, since bytes at random hardly ever are
// HDF5: parts left out, renamed, or of other shapes and values, then bytes of the file, then its
// length.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <hdf5.h>

#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"
#include "tests/fuzz/input_file.h"
#include "tests/pipeline/formats/hydrodynamics/sample_database.h"

namespace {

using namespace blocklift;
using namespace blocklift::pipeline;

constexpr std::array<const char*, 24> parts = {"/water/density",
                                               "/water/gravity",
                                               "/water/depth",
                                               "/bodies/names",
                                               "/bodies",
                                               "/water",
                                               "/states",
                                               "/states/0",
                                               "/frequencies",
                                               "/headings",
                                               "/states/0/reference_points",
                                               "/states/0/displaced_volumes",
                                               "/states/0/infinite_added_mass",
                                               "/states/0/added_mass",
                                               "/states/0/damping",
                                               "/states/0/retardation",
                                               "/states/0/froude_krylov",
                                               "/states/0/froude_krylov/re",
                                               "/states/0/froude_krylov/im",
                                               "/states/0/diffraction/re",
                                               "/states/0/diffraction/im",
                                               "/states/0/hydrostatic_stiffness",
                                               "/states/0/centres_of_mass",
                                               "/states/1"};

constexpr std::array<double, 8> extremes = {
    0, -1, 1e300, -1e300, 1e-300, std::numeric_limits<double>::infinity(), NAN, 1};

/// The bytes of an input one after the other; 0 behind the last.
class Bytes {
 public:
  explicit Bytes(std::string_view all) : rest_(all) {}
  bool is_left() const { return !rest_.empty(); }
  std::size_t next() {
    if (rest_.empty()) return 0;
    const auto value = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }

 private:
  std::string_view rest_;
};

/// A dataset of other shape, type and values in a part's place.
void put_other(hid_t file, const char* part, Bytes& bytes) {
  H5Ldelete(file, part, H5P_DEFAULT);
  const auto rank = static_cast<int>(bytes.next() % 4);
  std::array<hsize_t, 4> size{};
  hsize_t count = 1;
  for (int i = 0; i < rank; ++i) count *= size[i] = bytes.next() % 13;
  const std::vector<double> values(count + 1, extremes[bytes.next() % extremes.size()]);
  const hid_t space =
      rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, size.data(), nullptr);
  const std::array<hid_t, 3> types = {H5T_IEEE_F64LE, H5T_STD_I32LE, H5T_IEEE_F32LE};
  const hid_t set = H5Dcreate2(file, part, types[bytes.next() % types.size()], space, H5P_DEFAULT,
                               H5P_DEFAULT, H5P_DEFAULT);
  if (set >= 0) {
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set);
  }
  H5Sclose(space);
}

/// One value of a part.
void put_value(hid_t file, const char* part, Bytes& bytes) {
  const hid_t set = H5Dopen2(file, part, H5P_DEFAULT);
  if (set < 0) return;
  const hid_t space = H5Dget_space(set);
  const auto count =
      static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space)));
  const hid_t type = H5Dget_type(set);
  if (count > 0 && H5Tget_class(type) == H5T_FLOAT) {
    std::vector<double> values(count);
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values[(bytes.next() * 256 + bytes.next()) % count] = extremes[bytes.next() % extremes.size()];
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  H5Tclose(type);
  H5Sclose(space);
  H5Dclose(set);
}

void edit_parts(const std::string& path, Bytes& bytes) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  if (file < 0) return;
  for (std::size_t edits = bytes.next() % 5; edits > 0; --edits) {
    const char* part = parts[bytes.next() % parts.size()];
    if (H5Lexists(file, part, H5P_DEFAULT) < 0) continue;
    switch (bytes.next() % 6) {
      case 0:
        H5Ldelete(file, part, H5P_DEFAULT);
        break;
      case 1:
        H5Lmove(file, part, file, parts[bytes.next() % parts.size()], H5P_DEFAULT, H5P_DEFAULT);
        break;
      case 2:
        H5Lcreate_soft(part, file, parts[bytes.next() % parts.size()], H5P_DEFAULT, H5P_DEFAULT);
        break;
      case 3:
        put_other(file, part, bytes);
        break;
      default:
        put_value(file, part, bytes);
    }
  }
  H5Fclose(file);
}

std::string content_of(const std::filesystem::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

/// Bytes of the file, and its length.
void edit_bytes(const std::filesystem::path& path, Bytes& bytes) {
  if (!bytes.is_left()) return;
  std::string content = content_of(path);
  for (std::size_t edits = bytes.next() % 9; edits > 0 && !content.empty(); --edits) {
    // Most of what HDF5 says of the file stands at its beginning.
    const std::size_t reach = bytes.next() % 2 == 0 ? 4096 : content.size();
    const std::size_t place = (bytes.next() * 65536 + bytes.next() * 256 + bytes.next()) % reach;
    if (place < content.size()) content[place] = static_cast<char>(bytes.next());
  }
  if (bytes.next() % 8 == 7) content.resize(content.size() * bytes.next() / 256);
  std::ofstream(path, std::ios::binary) << content;
}

std::string sound_file(const fuzz::InputFolder& folder) {
  const auto path = folder.write("sound.h5", "");
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  write_hydrodynamic_database(path, make_sample_database(), "identity", "sample");
  return content_of(path);
}

void require_sound(const dynamics::HydrodynamicSeries& series) {
  for (const dynamics::HydrodynamicDatabase& database : series.databases) {
    const auto modes = static_cast<Eigen::Index>(6 * database.body_names.size());
    fuzz::require(std::isfinite(database.water.density) && database.water.density > 0);
    fuzz::require(database.infinite_added_mass.rows() == modes &&
                  database.infinite_added_mass.allFinite());
    fuzz::require(database.added_mass.size() == database.frequencies.size());
    for (const auto& mass : database.added_mass)
      fuzz::require(mass.rows() == modes && mass.cols() == modes && mass.allFinite());
    for (const auto& memory : database.retardation)
      fuzz::require(memory.rows() == modes && memory.allFinite());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  static const std::string sound = sound_file(folder);
  Bytes bytes(fuzz::text_of(data, size));
  const auto path = folder.write("database.h5", sound);
  edit_parts(path.string(), bytes);
  edit_bytes(path, bytes);
  read_identity(path);
  try {
    require_sound(read_hydrodynamic_file(path).series);
  } catch (const HydrodynamicFileError&) {
    // What is wrong was said.
  }
  return 0;
}
