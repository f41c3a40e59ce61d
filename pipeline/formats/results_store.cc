#include "pipeline/formats/results_store.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include "pipeline/formats/hdf5_handle.h"

namespace blocklift::pipeline {
namespace {

using hdf5::Handle;
using hdf5::QuietErrors;
using Shape = std::vector<hsize_t>;

/// Below this a dataset is stored in one piece: chunks and filters would cost more than they save.
constexpr std::size_t smallest_compressed_count = 1024;
constexpr hsize_t chunk_count = 65536;
// Shuffled doubles hardly shrink with more: level 4 takes a seventh more time for files that are
// 1.5 % smaller.
constexpr unsigned deflate_level = 1;
constexpr std::size_t most_numbers = std::size_t{1} << 40U;

[[noreturn]] void fail(const std::filesystem::path& file, std::string_view object,
                       const std::string& what) {
  const std::string reason = hdf5::take_reason();
  std::string text = file.string() + ": ";
  if (!object.empty()) text += "\"" + std::string(object) + "\": ";
  text += what;
  if (!reason.empty()) text += " (HDF5: " + reason + ")";
  throw ResultsError(text);
}

std::string absolute(std::string_view path) {
  return path.starts_with('/') ? std::string(path) : "/" + std::string(path);
}

/// Property list that makes missing groups on the way and takes names in UTF-8.
Handle link_creation() {
  Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(properties.get(), 1);
  H5Pset_char_encoding(properties.get(), H5T_CSET_UTF8);
  return properties;
}

/// Properties of what is made without the time at which it is: equal results are equal files.
Handle creation_without_time(hid_t kind) {
  Handle properties(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

/// Groups remember the order in which their members were made, the files the order of attributes.
Handle group_creation() {
  Handle properties = creation_without_time(H5P_GROUP_CREATE);
  H5Pset_link_creation_order(properties.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return properties;
}

/// Variable-length UTF-8 string: what h5py reads as str.
Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Handle make_space(const Shape& shape) {
  if (shape.empty()) return Handle(H5Screate(H5S_SCALAR), H5Sclose);
  return Handle(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
}

Handle dataset_creation(const Shape& shape, bool numerical) {
  Handle properties = creation_without_time(H5P_DATASET_CREATE);
  hsize_t count = 1;
  for (const hsize_t extent : shape) count *= extent;
  if (shape.empty() || !numerical || count < smallest_compressed_count) return properties;
  Shape chunk = shape;
  const hsize_t row = count / shape[0];
  chunk[0] = std::clamp<hsize_t>(chunk_count / std::max<hsize_t>(row, 1), 1, shape[0]);
  H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(properties.get());
  H5Pset_deflate(properties.get(), deflate_level);
  return properties;
}

std::string shape_text(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t extent : shape)
    text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return text;
}

std::string kind_name(H5T_class_t kind) {
  switch (kind) {
    case H5T_INTEGER:
      return "integers";
    case H5T_FLOAT:
      return "numbers";
    case H5T_STRING:
      return "texts";
    case H5T_COMPOUND:
      return "compounds, as h5py writes complex numbers (write real and imaginary part apart)";
    default:
      return "neither numbers nor texts";
  }
}

std::string list_of(const std::vector<std::string>& names) {
  if (names.empty()) return "nothing";
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

bool is_no_group(hid_t file, const std::string& path) {
  H5O_info_t info;
  return H5Oget_info_by_name(file, path.c_str(), &info, H5P_DEFAULT) >= 0 &&
         info.type != H5O_TYPE_GROUP;
}

/// Whether every link of an absolute path exists (H5Lexists alone fails on a missing middle); none
/// where a group on the way is damaged, so that it cannot be told. HDF5 1.10 says so once, and
/// takes what it has read of the group for sound from then on.
std::optional<bool> look_up(hid_t file, const std::string& path) {
  if (path == "/") return true;
  std::string above = "/";
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    std::string part = path.substr(0, end);
    const htri_t found = H5Lexists(file, part.c_str(), H5P_DEFAULT);
    if (found < 0 && !is_no_group(file, above)) return std::nullopt;
    if (found <= 0) return false;
    if (end == std::string::npos) return true;
    above = std::move(part);
  }
}

/// Reads one string attribute or dataset of variable or fixed length through `read`, which is given
/// the memory type and the place to put n strings.
template <typename Read>
std::vector<std::string> read_strings(hid_t stored_type, std::size_t count, hid_t space,
                                      const Read& read) {
  std::vector<std::string> texts(count);
  if (count == 0) return texts;
  if (H5Tis_variable_str(stored_type) > 0) {
    std::vector<char*> places(count, nullptr);
    const Handle type = text_type();
    if (read(type.get(), places.data()) < 0) return {};
    for (std::size_t i = 0; i < count; ++i)
      if (places[i] != nullptr) texts[i] = places[i];
    H5Dvlen_reclaim(type.get(), space, H5P_DEFAULT, places.data());
    return texts;
  }
  const std::size_t size = H5Tget_size(stored_type);
  std::vector<char> buffer(size * count, '\0');
  if (read(stored_type, buffer.data()) < 0) return {};
  for (std::size_t i = 0; i < count; ++i) {
    const char* begin = buffer.data() + i * size;
    texts[i].assign(begin, strnlen(begin, size));
  }
  return texts;
}

void put_text_attribute(const std::filesystem::path& path, hid_t object, std::string_view where,
                        std::string_view name, std::string_view value) {
  const std::string name_text(name);
  const std::string value_text(value);
  const Handle type = text_type();
  const Handle space = make_space({});
  if (H5Aexists(object, name_text.c_str()) > 0) H5Adelete(object, name_text.c_str());
  const Handle attribute(
      H5Acreate2(object, name_text.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  const char* place = value_text.c_str();
  if (!attribute || H5Awrite(attribute.get(), type.get(), &place) < 0)
    fail(path, where, "cannot write attribute \"" + name_text + "\"");
}

}  // namespace

// ---------------------------------------------------------------------------------------- writing

class ResultsWriter::File {
 public:
  File(std::filesystem::path name, const std::filesystem::path& temporary)
      : name_(std::move(name)) {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    // Groups with creation order need the format of HDF5 1.8, which every reader in use knows.
    H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_LATEST);
    const Handle creation = creation_without_time(H5P_FILE_CREATE);
    H5Pset_link_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    file_ =
        Handle(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
    if (!file_) fail(name_, "", "cannot make the file");
  }

  const std::filesystem::path& name() const { return name_; }
  hid_t id() const { return file_.get(); }

  bool has(const std::string& path) const { return look_up(id(), path).value_or(false); }

  void close() {
    if (!file_.reset()) fail(name_, "", "cannot write the last of the data");
  }

  /// Makes the groups of an absolute path one by one, each remembering the order of its members.
  void make_groups(const std::string& path) {
    const Handle links = link_creation();
    const Handle groups = group_creation();
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      const std::string part = path.substr(0, end);
      if (part != "/" && H5Lexists(id(), part.c_str(), H5P_DEFAULT) <= 0) {
        const Handle group(H5Gcreate2(id(), part.c_str(), links.get(), groups.get(), H5P_DEFAULT),
                           H5Gclose);
        if (!group) fail(name_, part, "cannot make the group");
      }
      if (end == std::string::npos) return;
    }
  }

  void put(std::string_view dataset, hid_t stored, hid_t memory, const Shape& shape,
           const void* data, const Meaning& meaning) {
    const std::string path = absolute(dataset);
    if (has(path)) fail(name_, path, "is written already; a dataset is written once");
    const std::size_t slash = path.rfind('/');
    if (slash > 0) make_groups(path.substr(0, slash));
    const bool numerical = H5Tget_class(stored) != H5T_STRING;
    const Handle space = make_space(shape);
    const Handle links = link_creation();
    const Handle creation = dataset_creation(shape, numerical);
    Handle set(H5Dcreate2(id(), path.c_str(), stored, space.get(), links.get(), creation.get(),
                          H5P_DEFAULT),
               H5Dclose);
    if (!set) fail(name_, path, "cannot make the dataset");
    hsize_t count = 1;
    for (const hsize_t extent : shape) count *= extent;
    if (count > 0 && H5Dwrite(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
      fail(name_, path, "cannot write the dataset");
    put_text_attribute(name_, set.get(), path, "units", meaning.units);
    put_text_attribute(name_, set.get(), path, "description", meaning.description);
    // Values may be written only here.
    if (!set.reset()) fail(name_, path, "cannot write the dataset");
  }

 private:
  std::filesystem::path name_;
  Handle file_;
};

namespace {

Handle open_object(hid_t file, const std::filesystem::path& name, const std::string& path) {
  Handle object(H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object) fail(name, path, "cannot be opened");
  return object;
}

}  // namespace

ResultsWriter::ResultsWriter(const std::filesystem::path& path) : target_(path) {
  const QuietErrors quiet;
  file_ = std::make_unique<File>(path, target_.temporary_path());
}

ResultsWriter::~ResultsWriter() {
  const QuietErrors quiet;
  file_.reset();
}

void ResultsWriter::make_group(std::string_view group) {
  const QuietErrors quiet;
  file_->make_groups(absolute(group));
}

void ResultsWriter::write_attribute(std::string_view object, std::string_view name,
                                    std::string_view value) {
  const QuietErrors quiet;
  const std::string path = absolute(object);
  if (!file_->has(path)) file_->make_groups(path);
  const Handle target = open_object(file_->id(), file_->name(), path);
  put_text_attribute(file_->name(), target.get(), path, name, value);
}

void ResultsWriter::write_attribute(std::string_view object, std::string_view name, double value) {
  const QuietErrors quiet;
  const std::string path = absolute(object);
  const std::string name_text(name);
  if (!file_->has(path)) file_->make_groups(path);
  const Handle target = open_object(file_->id(), file_->name(), path);
  const Handle space = make_space({});
  if (H5Aexists(target.get(), name_text.c_str()) > 0) H5Adelete(target.get(), name_text.c_str());
  const Handle attribute(H5Acreate2(target.get(), name_text.c_str(), H5T_IEEE_F64LE, space.get(),
                                    H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!attribute || H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0)
    fail(file_->name(), path, "cannot write attribute \"" + name_text + "\"");
}

void ResultsWriter::write(std::string_view dataset, std::span<const double> values,
                          const Meaning& meaning) {
  const QuietErrors quiet;
  file_->put(dataset, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {values.size()}, values.data(), meaning);
}

void ResultsWriter::write(std::string_view dataset, std::span<const std::int32_t> values,
                          const Meaning& meaning) {
  const QuietErrors quiet;
  file_->put(dataset, H5T_STD_I32LE, H5T_NATIVE_INT32, {values.size()}, values.data(), meaning);
}

void ResultsWriter::write_matrix(std::string_view dataset,
                                 const Eigen::Ref<const RowMajorMatrix>& values,
                                 const Meaning& meaning) {
  const QuietErrors quiet;
  // A block of a larger matrix has gaps between its rows: copy it into one piece.
  const RowMajorMatrix packed = values;
  file_->put(dataset, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
             {static_cast<hsize_t>(packed.rows()), static_cast<hsize_t>(packed.cols())},
             packed.data(), meaning);
}

void ResultsWriter::write_points(std::string_view dataset, std::span<const Eigen::Vector3d> points,
                                 const Meaning& meaning) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const QuietErrors quiet;
  file_->put(dataset, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {points.size(), 3}, points.data(),
             meaning);
}

void ResultsWriter::write_indices(std::string_view dataset, std::span<const std::int32_t> values,
                                  std::size_t columns, const Meaning& meaning) {
  const QuietErrors quiet;
  if (columns == 0 || values.size() % columns != 0)
    fail(file_->name(), dataset,
         std::to_string(values.size()) + " numbers do not fill rows of " + std::to_string(columns));
  file_->put(dataset, H5T_STD_I32LE, H5T_NATIVE_INT32, {values.size() / columns, columns},
             values.data(), meaning);
}

void ResultsWriter::write_array(std::string_view dataset, std::span<const double> values,
                                std::span<const std::size_t> shape, const Meaning& meaning) {
  const QuietErrors quiet;
  std::size_t count = 1;
  for (const std::size_t extent : shape) count *= extent;
  if (count != values.size())
    fail(
        file_->name(), dataset,
        std::to_string(values.size()) + " numbers do not fill a shape of " + std::to_string(count));
  file_->put(dataset, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, Shape(shape.begin(), shape.end()),
             values.data(), meaning);
}

void ResultsWriter::write_number(std::string_view dataset, double value, const Meaning& meaning) {
  const QuietErrors quiet;
  file_->put(dataset, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value, meaning);
}

void ResultsWriter::write_texts(std::string_view dataset, std::span<const std::string> texts,
                                std::string_view description) {
  const QuietErrors quiet;
  std::vector<const char*> places;
  for (const std::string& text : texts) places.push_back(text.c_str());
  const Handle type = text_type();
  file_->put(dataset, type.get(), type.get(), {texts.size()}, places.data(),
             {"", std::string(description)});
}

void ResultsWriter::write_text(std::string_view dataset, std::string_view text,
                               std::string_view description) {
  const QuietErrors quiet;
  const std::string copy(text);
  const char* place = copy.c_str();
  const Handle type = text_type();
  file_->put(dataset, type.get(), type.get(), {}, &place, {"", std::string(description)});
}

void ResultsWriter::finish() {
  const QuietErrors quiet;
  file_->close();
  target_.commit();
}

// ---------------------------------------------------------------------------------------- reading

class ResultsReader::File {
 public:
  explicit File(std::filesystem::path name) : name_(std::move(name)) {
    if (!std::filesystem::exists(name_)) fail(name_, "", "there is no such file");
    file_ = Handle(H5Fopen(name_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file_) fail(name_, "", "is not a readable HDF5 file");
  }

  const std::filesystem::path& name() const { return name_; }
  hid_t id() const { return file_.get(); }

  bool has(const std::string& path) const {
    const std::optional<bool> found = look_up(id(), path);
    if (!found) fail(name_, path, "cannot be looked up");
    return *found;
  }

  std::vector<std::string> children(const std::string& path) const {
    const Handle group = Handle(H5Gopen2(id(), path.c_str(), H5P_DEFAULT), H5Gclose);
    if (!group) fail(name_, path, "is not a group");
    const Handle properties(H5Gget_create_plist(group.get()), H5Pclose);
    unsigned order = 0;
    H5Pget_link_creation_order(properties.get(), &order);
    std::vector<std::string> names;
    const auto keep = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
      static_cast<std::vector<std::string>*>(out)->emplace_back(name);
      return 0;
    };
    const bool tracked = (order & H5P_CRT_ORDER_TRACKED) != 0;
    if (H5Literate(group.get(), tracked ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME, H5_ITER_INC, nullptr,
                   keep, &names) < 0)
      fail(name_, path, "cannot be listed");
    return names;
  }

  /// Says what the deepest existing group on the way to a missing path holds.
  void require(const std::string& path) const {
    if (has(path)) return;
    std::string parent = path;
    do {
      parent = parent.substr(0, parent.rfind('/'));
      if (parent.empty()) parent = "/";
    } while (!has(parent));
    if (is_no_group(id(), parent))
      fail(name_, path, "is not in the file; \"" + parent + "\" is a dataset");
    fail(name_, path, "is not in the file; \"" + parent + "\" holds " + list_of(children(parent)));
  }

  Handle open_dataset(const std::string& path) const {
    require(path);
    Handle set(H5Dopen2(id(), path.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set) fail(name_, path, "is not a dataset");
    return set;
  }

  template <typename Number>
  Array<Number> numbers(std::string_view dataset, hid_t memory, bool integers_only) const {
    const std::string path = absolute(dataset);
    const Handle set = open_dataset(path);
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type.get());
    if (kind != H5T_INTEGER && (integers_only || kind != H5T_FLOAT))
      fail(name_, path,
           "holds " + kind_name(kind) + "; " + (integers_only ? "integers" : "numbers") +
               " are due");
    Array<Number> array;
    array.values.resize(extents(set, path, array.shape));
    if (!array.values.empty() &&
        H5Dread(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) < 0)
      fail(name_, path, "cannot be read");
    return array;
  }

  std::vector<std::string> texts(const std::string& path) const {
    const Handle set = open_dataset(path);
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    if (H5Tget_class(type.get()) != H5T_STRING)
      fail(name_, path, "holds " + kind_name(H5Tget_class(type.get())) + "; texts are due");
    std::vector<std::size_t> shape;
    const std::size_t count = extents(set, path, shape);
    const Handle space(H5Dget_space(set.get()), H5Sclose);
    auto result = read_strings(type.get(), count, space.get(), [&](hid_t memory, void* place) {
      return H5Dread(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, place);
    });
    if (result.size() != count) fail(name_, path, "cannot be read");
    return result;
  }

  /// An attribute of one value, opened; the object must exist.
  Handle open_attribute(const std::string& path, std::string_view name) const {
    require(path);
    const std::string name_text(name);
    Handle attribute(
        H5Aopen_by_name(id(), path.c_str(), name_text.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!attribute) fail(name_, path, "has no attribute \"" + name_text + "\"");
    const Handle space(H5Aget_space(attribute.get()), H5Sclose);
    if (H5Sget_simple_extent_npoints(space.get()) != 1)
      fail(name_, path, "attribute \"" + name_text + "\" is a list; one value is due");
    return attribute;
  }

 private:
  /// Fills `shape` and returns the number of elements.
  std::size_t extents(const Handle& set, const std::string& path,
                      std::vector<std::size_t>& shape) const {
    const Handle space(H5Dget_space(set.get()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    Shape extent(static_cast<std::size_t>(std::max(rank, 0)));
    H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
    shape.assign(extent.begin(), extent.end());
    std::size_t count = 1;
    for (const std::size_t n : shape) {
      // More than any memory holds; damaged files say so.
      if (n > 0 && count > most_numbers / n)
        fail(name_, path, "has more values than can be read: it is of shape " + shape_text(shape));
      count *= n;
    }
    return count;
  }

  std::filesystem::path name_;
  Handle file_;
};

ResultsReader::ResultsReader(const std::filesystem::path& path) {
  const QuietErrors quiet;
  file_ = std::make_unique<File>(path);
}

ResultsReader::~ResultsReader() {
  const QuietErrors quiet;
  file_.reset();
}

bool ResultsReader::has(std::string_view object) const {
  const QuietErrors quiet;
  const bool found = file_->has(absolute(object));
  H5Eclear2(H5E_DEFAULT);
  return found;
}

std::vector<std::string> ResultsReader::children(std::string_view group) const {
  const QuietErrors quiet;
  const std::string path = absolute(group);
  file_->require(path);
  return file_->children(path);
}

bool ResultsReader::has_attribute(std::string_view object, std::string_view name) const {
  const QuietErrors quiet;
  const std::string path = absolute(object);
  if (!file_->has(path)) return false;
  const htri_t found =
      H5Aexists_by_name(file_->id(), path.c_str(), std::string(name).c_str(), H5P_DEFAULT);
  if (found < 0) fail(file_->name(), path, "has attributes that cannot be looked up");
  return found > 0;
}

std::string ResultsReader::read_text_attribute(std::string_view object,
                                               std::string_view name) const {
  const QuietErrors quiet;
  const std::string path = absolute(object);
  const Handle attribute = file_->open_attribute(path, name);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (H5Tget_class(type.get()) != H5T_STRING)
    fail(file_->name(), path, "attribute \"" + std::string(name) + "\" does not hold text");
  const auto texts = read_strings(type.get(), 1, space.get(), [&](hid_t memory, void* place) {
    return H5Aread(attribute.get(), memory, place);
  });
  if (texts.empty())
    fail(file_->name(), path, "attribute \"" + std::string(name) + "\" cannot be read");
  return texts.front();
}

double ResultsReader::read_number_attribute(std::string_view object, std::string_view name) const {
  const QuietErrors quiet;
  const std::string path = absolute(object);
  const Handle attribute = file_->open_attribute(path, name);
  double value = 0.0;
  if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0)
    fail(file_->name(), path, "attribute \"" + std::string(name) + "\" does not hold a number");
  return value;
}

Meaning ResultsReader::read_meaning(std::string_view dataset) const {
  return {read_text_attribute(dataset, "units"), read_text_attribute(dataset, "description")};
}

Array<double> ResultsReader::read(std::string_view dataset) const {
  const QuietErrors quiet;
  return file_->numbers<double>(dataset, H5T_NATIVE_DOUBLE, false);
}

Array<std::int32_t> ResultsReader::read_indices(std::string_view dataset) const {
  const QuietErrors quiet;
  return file_->numbers<std::int32_t>(dataset, H5T_NATIVE_INT32, true);
}

std::vector<std::string> ResultsReader::read_texts(std::string_view dataset) const {
  const QuietErrors quiet;
  return file_->texts(absolute(dataset));
}

std::string ResultsReader::read_text(std::string_view dataset) const {
  const auto texts = read_texts(dataset);
  if (texts.size() != 1)
    fail(file_->name(), dataset, "holds " + std::to_string(texts.size()) + " texts; one is due");
  return texts.front();
}

}  // namespace blocklift::pipeline
