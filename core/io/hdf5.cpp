#include "core/io/hdf5.hpp"

#include <algorithm>
#include <hdf5.h>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/base/errors.hpp"

namespace perifrac {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>, "the header stores HDF5 identifiers as int64");

/// One identifier of HDF5 and the function that gives it back.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) {
      close_(id_);
    }
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

template <class Number>
hid_t type_of() {
  if constexpr (std::is_same_v<Number, double>) {
    return H5T_NATIVE_DOUBLE;
  } else if constexpr (std::is_same_v<Number, std::int64_t>) {
    return H5T_NATIVE_INT64;
  } else if constexpr (std::is_same_v<Number, std::int32_t>) {
    return H5T_NATIVE_INT32;
  } else {
    static_assert(std::is_same_v<Number, std::uint8_t>);
    return H5T_NATIVE_UINT8;
  }
}

/// A string of fixed length, padded with zeros: HDF5 has none of length 0.
hid_t make_text_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::max<std::size_t>(length, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

std::string without_padding(std::string text) {
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

/// What HDF5 says went wrong first. Where the system refused, HDF5 quotes its words.
std::string reason() {
  std::string text = "unknown reason";
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned depth, const H5E_error2_t* error, void* out) -> herr_t {
        if (depth == 0 && error->desc != nullptr) {
          *static_cast<std::string*>(out) = error->desc;
        }
        return 0;
      },
      &text);
  const std::string quote = "error message = '";
  if (const auto begin = text.find(quote); begin != std::string::npos) {
    text = text.substr(begin + quote.size());
    text = text.substr(0, text.find('\''));
  }
  return text;
}

/// Errors become exceptions, so HDF5 shall not print them as well.
void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

[[noreturn]] void misused(const std::string& doing) {
  throw std::logic_error("HDF5 file in memory: " + doing + ": " + reason());
}

}  // namespace

Hdf5Writer::Hdf5Writer() {
  constexpr std::size_t growth = 1 << 20;  // bytes
  silence_hdf5();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, growth, false);  // in memory, not to be saved
  id_ = H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (id_ < 0) {
    misused("creating the file");
  }
}

Hdf5Writer::~Hdf5Writer() { H5Fclose(id_); }

std::int64_t Hdf5Writer::create_dataset(const std::string& name, std::int64_t type,
                                        std::int64_t space) {
  const Handle link_properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link_properties, 1);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);  // no dates: same content, same bytes
  const hid_t dataset =
      H5Dcreate2(id_, name.c_str(), type, space, link_properties, properties, H5P_DEFAULT);
  if (dataset < 0) {
    misused("creating " + name);
  }
  return dataset;
}

template <class Number>
void Hdf5Writer::write(const std::string& name, std::span<const Number> values,
                       std::size_t columns) {
  const hsize_t shape[] = {values.size() / columns, columns};
  const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, shape, nullptr), H5Sclose);
  const Handle dataset(create_dataset(name, type_of<Number>(), space), H5Dclose);
  if (H5Dwrite(dataset, type_of<Number>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    misused("writing " + name);
  }
}

void Hdf5Writer::write_columns(const std::string& name,
                               std::span<const std::span<const double>> given,
                               std::size_t columns) {
  constexpr std::size_t rows_at_once = 4096;  // lest the whole be there twice
  const std::size_t count = given.empty() ? 0 : given.front().size();
  const hsize_t shape[] = {count, columns};
  const Handle space(H5Screate_simple(2, shape, nullptr), H5Sclose);
  const Handle dataset(create_dataset(name, type_of<double>(), space), H5Dclose);
  std::vector<double> rows;
  for (std::size_t first = 0; first < count; first += rows_at_once) {
    const std::size_t taken = std::min(rows_at_once, count - first);
    rows.assign(taken * columns, 0.0);
    for (std::size_t column = 0; column < given.size(); ++column) {
      for (std::size_t k = 0; k < taken; ++k) {
        rows[k * columns + column] = given[column][first + k];
      }
    }
    const hsize_t begin[] = {first, 0}, size[] = {taken, columns};
    const Handle part(H5Screate_simple(2, size, nullptr), H5Sclose);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, begin, nullptr, size, nullptr);
    if (H5Dwrite(dataset, type_of<double>(), part, space, H5P_DEFAULT, rows.data()) < 0) {
      misused("writing " + name);
    }
  }
}

void Hdf5Writer::write_text(const std::string& name, const std::string& text) {
  const Handle type(make_text_type(text.size()), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle dataset(create_dataset(name, type, space), H5Dclose);
  if (H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0) {
    misused("writing " + name);
  }
}

void Hdf5Writer::create_group(const std::string& name) {
  const Handle group(H5Gcreate2(id_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Gclose);
  if (group < 0) {
    misused("creating " + name);
  }
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name,
                                 const std::string& text) {
  const Handle type(make_text_type(text.size()), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate_by_name(id_, object.c_str(), name.c_str(), type, space,
                                           H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (attribute < 0 || H5Awrite(attribute, type, text.c_str()) < 0) {
    misused("writing " + object + "@" + name);
  }
}

void Hdf5Writer::write_attribute(const std::string& object, const std::string& name,
                                 std::span<const std::int64_t> values) {
  const hsize_t shape[] = {values.size()};
  const Handle space(H5Screate_simple(1, shape, nullptr), H5Sclose);
  const Handle attribute(H5Acreate_by_name(id_, object.c_str(), name.c_str(), H5T_NATIVE_INT64,
                                           space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (attribute < 0 || H5Awrite(attribute, H5T_NATIVE_INT64, values.data()) < 0) {
    misused("writing " + object + "@" + name);
  }
}

std::string_view Hdf5Writer::bytes() const {
  void* memory = nullptr;  // of the driver that keeps files in memory: where it holds their address
  const bool is_there =
      H5Fflush(id_, H5F_SCOPE_LOCAL) >= 0 && H5Fget_vfd_handle(id_, H5P_DEFAULT, &memory) >= 0;
  const ssize_t size = H5Fget_file_image(id_, nullptr, 0);
  if (!is_there || size < 0) misused("taking its bytes");
  return {*static_cast<const char* const*>(memory), static_cast<std::size_t>(size)};
}

Hdf5Reader::Hdf5Reader(std::filesystem::path file) : file_(std::move(file)) {
  silence_hdf5();
  id_ = H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id_ < 0) {
    fail("opening it");
  }
}

Hdf5Reader::~Hdf5Reader() { H5Fclose(id_); }

void Hdf5Reader::fail(const std::string& doing) const {
  throw InputError(file_.string() + ": cannot be read: " + reason() + " (" + doing + ")");
}

std::int64_t Hdf5Reader::open_dataset(const std::string& name) const {
  const hid_t dataset = H5Dopen2(id_, name.c_str(), H5P_DEFAULT);
  if (dataset < 0) {
    fail("reading " + name);
  }
  return dataset;
}

template <class Number>
std::vector<Number> Hdf5Reader::read(const std::string& name) const {
  const Handle dataset(open_dataset(name), H5Dclose);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  std::vector<Number> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  if (H5Dread(dataset, type_of<Number>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail("reading " + name);
  }
  return values;
}

std::string Hdf5Reader::read_text(const std::string& name) const {
  const Handle dataset(open_dataset(name), H5Dclose);
  const Handle type(H5Dget_type(dataset), H5Tclose);
  std::string text(H5Tget_size(type), '\0');
  if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) {
    fail("reading " + name);
  }
  return without_padding(std::move(text));
}

std::string Hdf5Reader::read_text_attribute(const std::string& object,
                                            const std::string& name) const {
  const Handle attribute(
      H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (attribute < 0) {
    fail("reading " + object + "@" + name);
  }
  const Handle type(H5Aget_type(attribute), H5Tclose);
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0) {
    fail("reading " + object + "@" + name);
  }
  return without_padding(std::move(text));
}

bool Hdf5Reader::holds_integers(const std::string& name) const {
  const Handle dataset(open_dataset(name), H5Dclose);
  const Handle type(H5Dget_type(dataset), H5Tclose);
  return H5Tget_class(type) == H5T_INTEGER;
}

std::vector<std::string> Hdf5Reader::datasets(const std::string& group) const {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5O_info_t* info, void* out) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) {
      static_cast<std::vector<std::string>*>(out)->push_back(name);
    }
    return 0;
  };
  if (H5Ovisit_by_name2(id_, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, collect, &names,
                        H5O_INFO_BASIC, H5P_DEFAULT) < 0) {
    fail("reading " + group);
  }
  return names;
}

template void Hdf5Writer::write(const std::string&, std::span<const double>, std::size_t);
template void Hdf5Writer::write(const std::string&, std::span<const std::int64_t>, std::size_t);
template void Hdf5Writer::write(const std::string&, std::span<const std::int32_t>, std::size_t);
template void Hdf5Writer::write(const std::string&, std::span<const std::uint8_t>, std::size_t);
template std::vector<double> Hdf5Reader::read(const std::string&) const;
template std::vector<std::int64_t> Hdf5Reader::read(const std::string&) const;
template std::vector<std::int32_t> Hdf5Reader::read(const std::string&) const;
template std::vector<std::uint8_t> Hdf5Reader::read(const std::string&) const;

}  // namespace perifrac
