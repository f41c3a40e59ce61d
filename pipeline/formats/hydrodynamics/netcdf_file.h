#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

/// Numbers of a NetCDF variable with the names of its dimensions. Of a NetCDF-4 file that does not
/// name them all there are fewer names than the array has dimensions.
struct NetcdfVariable {
  std::vector<std::string> dimensions;
  Array<double> array;

  /// Value at one index for each named dimension; dimensions that are not named have one place.
  double at(const std::map<std::string, std::size_t>& place) const;
};

/// Reads a NetCDF file of either kind, told apart by its first bytes: NetCDF-4, an HDF5 file, is
/// read through HDF5; the classic formats (NetCDF-3, with offsets of 32 or 64 bits, and CDF-5) by
/// their own specification (Unidata, "NetCDF classic format specification"). Texts are strings, or
/// characters along a last dimension of their own, as classic files must have them. Complex numbers
/// that are compounds of r and i, as h5py and h5netcdf write them, have their parts along a last
/// dimension "complex", the real one first. All functions throw ResultsError that names the file
/// and the variable.
class NetcdfFile {
 public:
  explicit NetcdfFile(const std::filesystem::path& path);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  bool has(const std::string& name) const;
  /// Are its values texts?
  bool holds_texts(const std::string& name) const;
  NetcdfVariable read(const std::string& name) const;
  /// In the order of the file; blanks and zeros at the ends of characters are left out.
  std::vector<std::string> read_texts(const std::string& name) const;

  /// One of the kinds of files.
  class Source {
   public:
    virtual ~Source() = default;
    virtual bool has(const std::string& name) const = 0;
    virtual bool holds_texts(const std::string& name) const = 0;
    virtual NetcdfVariable read(const std::string& name) const = 0;
    virtual std::vector<std::string> read_texts(const std::string& name) const = 0;
  };

 private:
  std::unique_ptr<const Source> source_;
};

/// A file of the classic formats. @throws ResultsError if it is none or is cut off.
std::unique_ptr<const NetcdfFile::Source> open_classic_netcdf(const std::filesystem::path& path);

/// The rows of a table of characters, without blanks and zeros at their ends.
std::vector<std::string> texts_of_characters(const std::string& characters, std::size_t length);

}  // namespace blocklift::pipeline
