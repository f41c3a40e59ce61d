// Files of Capytaine: conventions by hand, and what its versions leave out or add.
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/formats/hdf5_handle.h"
#include "pipeline/formats/hydrodynamics/foreign_hydrodynamics.h"
#include "pipeline/formats/results_store.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::Vector3;
using ::testing::HasSubstr;
using Complex = std::complex<double>;

template <class Action>
std::string refusal_of_capytaine(const Action& action) {
  try {
    action();
  } catch (const HydrodynamicFileError& error) {
    return error.what();
  }
  return {};
}

/// Names the dimensions of a variable as NetCDF-4 does: references to the coordinates' variables.
void name_dimensions(const std::string& file, const std::string& variable,
                     const std::vector<std::string>& dimensions) {
  using hdf5::Handle;
  const Handle handle(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  const Handle set(H5Dopen2(handle.get(), variable.c_str(), H5P_DEFAULT), H5Dclose);
  std::vector<hobj_ref_t> references(dimensions.size());
  std::vector<hvl_t> lists;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    H5Rcreate(&references[d], handle.get(), dimensions[d].c_str(), H5R_OBJECT, -1);
    lists.push_back({1, &references[d]});
  }
  if (H5Aexists(set.get(), "DIMENSION_LIST") > 0) H5Adelete(set.get(), "DIMENSION_LIST");
  const Handle type(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose);
  const hsize_t count = dimensions.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle attribute(
      H5Acreate2(set.get(), "DIMENSION_LIST", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  H5Awrite(attribute.get(), type.get(), lists.data());
}

/// A file of NetCDF's first classic format, put together byte by byte.
class ClassicWriter {
 public:
  std::size_t dimension(const std::string& name, std::size_t length) {
    dimensions_ += text(name) + word(length);
    return dimension_count_++;
  }
  void numbers(const std::string& name, const std::vector<std::size_t>& dimensions,
               const std::vector<double>& values) {
    std::string data;
    for (const double value : values) data += word(bits(value) >> 32) + word(bits(value));
    variables_.push_back({name, dimensions, 6, data});
  }
  void floats(const std::string& name, const std::vector<std::size_t>& dimensions,
              const std::vector<float>& values) {
    std::string data;
    for (const float value : values) data += word(std::bit_cast<std::uint32_t>(value));
    variables_.push_back({name, dimensions, 5, data});
  }
  void characters(const std::string& name, const std::vector<std::size_t>& dimensions,
                  const std::string& data) {
    variables_.push_back({name, dimensions, 2, data});
  }
  std::string bytes() const {
    const std::size_t length = layout(0).size();
    std::string file = layout(length);
    for (const Entry& entry : variables_) file += padded(entry.data);
    return file;
  }

 private:
  struct Entry {
    std::string name;
    std::vector<std::size_t> dimensions;
    std::size_t type;
    std::string data;
  };
  static std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }
  static std::string word(std::uint64_t value) {
    std::string result;
    for (int shift = 24; shift >= 0; shift -= 8) {
      result += static_cast<char>(static_cast<unsigned char>(value >> shift & 255U));
    }
    return result;
  }
  static std::string padded(std::string data) {
    data.resize((data.size() + 3) / 4 * 4, '\0');
    return data;
  }
  static std::string text(const std::string& name) { return word(name.size()) + padded(name); }
  std::string layout(std::size_t begin) const {
    std::string file = "CDF\x01" + word(0);
    file += word(10) + word(dimension_count_) + dimensions_;
    file += word(12) + word(1) + text("made") + word(2) + text("by hand");
    file += word(11) + word(variables_.size());
    for (const Entry& entry : variables_) {
      file += text(entry.name) + word(entry.dimensions.size());
      for (const std::size_t dimension : entry.dimensions) file += word(dimension);
      file += word(0) + word(0) + word(entry.type) + word(padded(entry.data).size()) + word(begin);
      begin += padded(entry.data).size();
    }
    return file;
  }

  std::string dimensions_;
  std::size_t dimension_count_ = 0;
  std::vector<Entry> variables_;
};

/// A body that heaves alone at 3, 2 and 1 rad/s, without what is optional: added mass 10 + w,
/// damping w, excitation (2 + 1i) w with its imaginary part first; frequencies as floats.
std::string classic_sample() {
  ClassicWriter file;
  const std::size_t omega = file.dimension("omega", 3),
                    radiating = file.dimension("radiating_dof", 1),
                    influenced = file.dimension("influenced_dof", 2),
                    direction = file.dimension("wave_direction", 2),
                    parts = file.dimension("reim", 2), five = file.dimension("string5", 5),
                    two = file.dimension("string2", 2);
  file.numbers("rho", {}, {1000.0});
  file.numbers("g", {}, {9.81});
  file.numbers("water_depth", {}, {std::numeric_limits<double>::infinity()});
  file.floats("omega", {omega}, {3.0F, 2.0F, 1.0F});
  file.characters("radiating_dof", {radiating, five}, "Heave");
  file.characters("influenced_dof", {influenced, five}, std::string("HeaveSway\0", 10));
  file.characters("reim", {parts, two}, "imre");
  file.numbers("wave_direction", {direction}, {0.25, 0.5});
  file.numbers("added_mass", {radiating, omega, influenced}, {13, 1, 12, 1, 11, 1});
  file.numbers("radiation_damping", {radiating, omega, influenced}, {3, 0, 2, 0, 1, 0});
  std::vector<double> force;
  for (const double part : {1.0, 2.0}) {
    for (const double heading : {1.0, 10.0}) {
      for (const double w : {3.0, 2.0, 1.0}) {
        force.push_back(part * heading * w);
        force.push_back(0.0);
      }
    }
  }
  file.numbers("excitation_force", {parts, direction, omega, influenced}, force);
  return file.bytes();
}

/// A body that heaves and surges at the frequencies infinity, 3, 2 and 1 rad/s: added mass of heave
/// 10 + w, of surge by heave 1, damping of heave w, forces (1 + 2i) w in heave and 5 in surge.
void write_sample_of_capytaine(const std::string& path,
                               const std::vector<std::string>& motions = {"Heave", "Surge"}) {
  const std::vector<double> omega = {std::numeric_limits<double>::infinity(), 3.0, 2.0, 1.0};
  std::vector<double> mass, damping, diffraction;
  for (const double w : omega) {
    const bool infinite = std::isinf(w);
    for (const double value : {infinite ? 9.0 : 10.0 + w, 1.0, 0.0, 4.0}) mass.push_back(value);
    for (const double value : {infinite ? 0.0 : w, 0.0, 0.0, 0.5}) damping.push_back(value);
  }
  for (const double factor : {1.0, 2.0}) {
    for (const double w : omega) {
      diffraction.push_back(factor * (std::isinf(w) ? 0.0 : w));
      diffraction.push_back(factor == 1.0 ? 5.0 : 0.0);
    }
  }
  {
    ResultsWriter file(path);
    const Meaning none{"1", "made by hand"};
    file.write_number("rho", 1000.0, none);
    file.write_number("g", 9.81, none);
    file.write_number("water_depth", std::numeric_limits<double>::infinity(), none);
    file.write("omega", std::span<const double>(omega), none);
    const std::vector<double> heading = {0.5}, parts = {0.0, 1.0};
    file.write("wave_direction", std::span<const double>(heading), none);
    file.write("complex", std::span<const double>(parts), none);
    file.write_texts("radiating_dof", motions, "");
    file.write_texts("influenced_dof", motions, "");
    const std::size_t square[] = {4, 2, 2}, force[] = {2, 4, 1, 2};
    file.write_array("added_mass", mass, square, none);
    file.write_array("radiation_damping", damping, square, none);
    file.write_array("diffraction_force", diffraction, force, none);
    file.write_array("Froude_Krylov_force", diffraction, force, none);
    file.finish();
  }
  for (const char* const name : {"added_mass", "radiation_damping"}) {
    name_dimensions(path, name, {"omega", "radiating_dof", "influenced_dof"});
  }
  for (const char* const name : {"diffraction_force", "Froude_Krylov_force"}) {
    name_dimensions(path, name, {"complex", "omega", "wave_direction", "influenced_dof"});
  }
}

// Conventions by hand: degrees of freedom by name, frequencies brought into order, the force
// conjugated from e^{-i w t} to e^{+i w t}, row: what is influenced, column: what moves.
TEST(Capytaine, IsReadByTheNamesOfItsDimensions) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  const HydrodynamicDatabase database =
      import_hydrodynamics("body.nc", {}).series.databases.front();
  EXPECT_EQ(database.frequencies, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(database.added_mass[1](2, 2), 12.0);
  EXPECT_EQ(database.added_mass[1](0, 2), 1.0);
  EXPECT_EQ(database.added_mass[1](2, 0), 0.0);
  EXPECT_EQ(database.added_mass[1](0, 0), 4.0);
  EXPECT_EQ(database.infinite_added_mass(2, 2), 9.0);
  EXPECT_EQ(database.damping[2](2, 2), 3.0);
  EXPECT_EQ(database.diffraction[2](2, 0), Complex(3.0, -6.0));
  EXPECT_EQ(database.excitation(0)(0, 0), Complex(10.0, 0.0));
  EXPECT_EQ(database.headings, std::vector<double>{0.5});
}

// As h5py and h5netcdf write a dataset whose parts were not taken apart. Other files' numbers may
// not be such, which is said.
TEST(Capytaine, ReadsComplexNumbers) {
  using hdf5::Handle;
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  const HydrodynamicDatabase apart = import_hydrodynamics("body.nc", {}).series.databases.front();
  {
    const Handle file(H5Fopen("body.nc", H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Complex)), H5Tclose);
    H5Tinsert(type.get(), "r", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(type.get(), "i", sizeof(double), H5T_NATIVE_DOUBLE);
    const hsize_t extents[] = {4, 1, 2};
    const Handle space(H5Screate_simple(3, extents, nullptr), H5Sclose);
    std::vector<Complex> force;
    for (const double w : {0.0, 3.0, 2.0, 1.0}) {
      force.emplace_back(w, 2.0 * w);
      force.emplace_back(5.0, 0.0);
    }
    for (const char* const name : {"diffraction_force", "Froude_Krylov_force"}) {
      H5Ldelete(file.get(), name, H5P_DEFAULT);
      const Handle set(H5Dcreate2(file.get(), name, type.get(), space.get(), H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose);
      H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, force.data());
    }
  }
  for (const char* const name : {"diffraction_force", "Froude_Krylov_force"}) {
    name_dimensions("body.nc", name, {"omega", "wave_direction", "influenced_dof"});
  }
  const HydrodynamicDatabase together =
      import_hydrodynamics("body.nc", {}).series.databases.front();
  EXPECT_EQ(together.frequencies, apart.frequencies);
  for (std::size_t k = 0; k < apart.frequencies.size(); ++k) {
    EXPECT_EQ(together.diffraction[k], apart.diffraction[k]);
    EXPECT_EQ(together.froude_krylov[k], apart.froude_krylov[k]);
  }
  try {
    ResultsReader("body.nc").read("diffraction_force");
    FAIL() << "is read as numbers";
  } catch (const ResultsError& error) {
    EXPECT_THAT(error.what(), HasSubstr("write real and imaginary part apart"));
  }
}

TEST(Capytaine, IsReadInTheClassicFormat) {
  const test::TemporaryFolder folder;
  folder.write("classic.nc", classic_sample());
  const HydrodynamicDatabase database =
      import_hydrodynamics("classic.nc", {}).series.databases.front();
  EXPECT_EQ(database.water.density, 1000.0);
  EXPECT_EQ(database.frequencies, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(database.headings, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(database.added_mass[1](2, 2), 12.0);
  EXPECT_EQ(database.added_mass[1](1, 2), 1.0);
  EXPECT_EQ(database.damping[2](2, 2), 3.0);
  EXPECT_EQ(database.excitation(0)(2, 0), Complex(2.0, -1.0));
  EXPECT_EQ(database.excitation(2)(2, 1), Complex(60.0, -30.0));
}

// Every cut of the file, and counts and places that it cannot have, are refused or read.
TEST(Capytaine, RefusesDamagedClassicFiles) {
  const test::TemporaryFolder folder;
  const std::string sound = classic_sample();
  for (std::size_t length = 3; length < sound.size(); length += 5) {
    folder.write("cut.nc", sound.substr(0, length));
    EXPECT_THAT(refusal_of_capytaine([] { read_capytaine("cut.nc"); }), HasSubstr("cut.nc: "));
  }
  for (std::size_t place = 3; place < 700; ++place) {
    std::string damaged = sound;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x5A);
    folder.write("damaged.nc", damaged);
    refusal_of_capytaine([] { read_capytaine("damaged.nc"); });
  }
}

// As another NetCDF library writes names into HDF5: one character a place.
TEST(Capytaine, ReadsNamesOfCharacters) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  {
    using hdf5::Handle;
    const Handle file(H5Fopen("body.nc", H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    const hsize_t extents[] = {2, 6};
    const Handle space(H5Screate_simple(2, extents, nullptr), H5Sclose);
    for (const char* const name : {"radiating_dof", "influenced_dof"}) {
      H5Ldelete(file.get(), name, H5P_DEFAULT);
      const Handle set(H5Dcreate2(file.get(), name, type.get(), space.get(), H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose);
      H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, "Heave\0Surge ");
    }
  }
  for (const char* const name : {"added_mass", "radiation_damping"}) {
    name_dimensions("body.nc", name, {"omega", "radiating_dof", "influenced_dof"});
  }
  for (const char* const name : {"diffraction_force", "Froude_Krylov_force"}) {
    name_dimensions("body.nc", name, {"complex", "omega", "wave_direction", "influenced_dof"});
  }
  const HydrodynamicDatabase database = read_capytaine("body.nc");
  EXPECT_EQ(database.added_mass[1](2, 2), 12.0);
  EXPECT_EQ(database.added_mass[1](0, 2), 1.0);
}

/// Writes a number, a row, or several rows into a file of HDF5 that has them, or has them not.
void set_number(const std::string& path, const char* name, std::initializer_list<double> values,
                hsize_t rows = 1) {
  using hdf5::Handle;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  if (H5Lexists(file.get(), name, H5P_DEFAULT) > 0) H5Ldelete(file.get(), name, H5P_DEFAULT);
  const hsize_t row = values.size(), table[] = {rows, values.size() / rows};
  const Handle space(values.size() == 1 ? H5Screate(H5S_SCALAR)
                     : rows == 1        ? H5Screate_simple(1, &row, nullptr)
                                        : H5Screate_simple(2, table, nullptr),
                     H5Sclose);
  const Handle set(H5Dcreate2(file.get(), name, H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT,
                              H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  H5Dwrite(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.begin());
}

// assemble_dataset writes neither centre (capytaine/io/xarray.py, hydrostatics_dataset: inertia and
// stiffness alone), but the bodies' rotations are about the centre of mass where they have one.
TEST(Capytaine, IsToldWhatItsRotationsAreAbout) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  const WamitBody there = {Vector3(1, 2, -3), 0.0};
  EXPECT_FALSE(tells_rotation_centres("body.nc"));
  EXPECT_EQ(read_capytaine("body.nc").reference_points[0], Vector3(0, 0, 0));
  EXPECT_EQ(read_capytaine("body.nc", {there}).reference_points[0], Vector3(1, 2, -3));
  EXPECT_THAT(refusal_of_capytaine([] {
                read_capytaine("body.nc", {WamitBody{}, WamitBody{}});
              }),
              HasSubstr("holds 1 bodies, and 2 are placed"));
  EXPECT_THAT(refusal_of_capytaine([] {
                read_capytaine("body.nc", {WamitBody{Vector3::Zero(), 0.5}});
              }),
              HasSubstr("along the world's axes"));
  set_number("body.nc", "center_of_mass", {0, 0, -2});
  EXPECT_TRUE(tells_rotation_centres("body.nc"));
  EXPECT_EQ(read_capytaine("body.nc").reference_points[0], Vector3(0, 0, -2));
  EXPECT_THAT(refusal_of_capytaine([] { read_capytaine("body.nc", {WamitBody{}}); }),
              HasSubstr("tells itself what its rotations are about"));
  set_number("body.nc", "center_of_mass", {0, 0});
  EXPECT_THAT(refusal_of_capytaine([] { read_capytaine("body.nc"); }),
              HasSubstr("three for each of 1 bodies are due"));
}

// Rows are bodies or axes, whichever the shape of two bodies tells.
TEST(Capytaine, ReadsPointsAlongEitherDimension) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("pair.nc", {"a__Heave", "b__Heave"});
  set_number("pair.nc", "center_of_mass", {1, 2, 3, 4, 5, 6}, 2);
  EXPECT_EQ(read_capytaine("pair.nc").centres_of_mass[1], Vector3(4, 5, 6));
  set_number("pair.nc", "center_of_mass", {1, 4, 2, 5, 3, 6}, 3);
  EXPECT_EQ(read_capytaine("pair.nc").centres_of_mass[1], Vector3(4, 5, 6));
}

// The forces of a vessel under way are those at the frequency of encounter (capytaine's
// encounter_omega), and none of a vessel at rest.
TEST(Capytaine, RefusesVesselsUnderWay) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  set_number("body.nc", "forward_speed", {0.0});
  EXPECT_EQ(read_capytaine("body.nc").frequencies.size(), 3U);
  set_number("body.nc", "forward_speed", {2.0});
  EXPECT_THAT(refusal_of_capytaine([] { read_capytaine("body.nc"); }),
              HasSubstr("\"forward_speed\" is 2 m/s"));
}

// assemble_dataset(..., omega=False) leaves the angular frequencies out. By hand: 2 pi/T.
TEST(Capytaine, TakesFrequenciesFromPeriods) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  const double turn = 2.0 * std::numbers::pi;
  set_number("body.nc", "omega", {0.0, turn / 3.0, turn / 2.0, turn});
  {
    const hdf5::Handle file(H5Fopen("body.nc", H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    H5Lmove(file.get(), "omega", file.get(), "period", H5P_DEFAULT, H5P_DEFAULT);
  }
  for (const char* const name : {"added_mass", "radiation_damping"})
    name_dimensions("body.nc", name, {"period", "radiating_dof", "influenced_dof"});
  for (const char* const name : {"diffraction_force", "Froude_Krylov_force"})
    name_dimensions("body.nc", name, {"complex", "period", "wave_direction", "influenced_dof"});
  const HydrodynamicDatabase database = read_capytaine("body.nc");
  ASSERT_EQ(database.frequencies.size(), 3U);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(database.frequencies[k], k + 1.0, 1e-14);
  EXPECT_EQ(database.infinite_added_mass(2, 2), 9.0);
  EXPECT_EQ(database.added_mass[1](2, 2), 12.0);
}

// Where datasets of different degrees of freedom are merged, xarray fills with nan.
TEST(Capytaine, NamesTheForceThatIsMissing) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  const double none = std::numeric_limits<double>::quiet_NaN();
  {
    const hdf5::Handle file(H5Fopen("body.nc", H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const hdf5::Handle set(H5Dopen2(file.get(), "added_mass", H5P_DEFAULT), H5Dclose);
    const hdf5::Handle all(H5Dget_space(set.get()), H5Sclose);
    const hdf5::Handle one(H5Screate(H5S_SCALAR), H5Sclose);
    const hsize_t place[] = {1, 0, 1};
    H5Sselect_elements(all.get(), H5S_SELECT_SET, 1, place);
    H5Dwrite(set.get(), H5T_NATIVE_DOUBLE, one.get(), all.get(), H5P_DEFAULT, &none);
  }
  EXPECT_THAT(refusal_of_capytaine([] { read_capytaine("body.nc"); }),
              HasSubstr("no number for the force on \"Surge\" from \"Heave\" at 3 rad/s"));
}

TEST(Capytaine, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  hdf5::Handle file(H5Fopen("body.nc", H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  H5Ldelete(file.get(), "radiation_damping", H5P_DEFAULT);
  file.reset();
  EXPECT_THAT(refusal_of_capytaine([] { read_capytaine("body.nc"); }),
              HasSubstr("\"/radiation_damping\": is not in the file"));
}

}  // namespace
}  // namespace blocklift::pipeline
