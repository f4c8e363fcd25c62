#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace perifrac {

/// An HDF5 file in the making. It grows in memory and is handed over as bytes: HDF5 itself may
/// crash where the disk is full, so it never sees the disk. Names of datasets may be paths: the
/// groups on the way are made. `Number` is double, std::int64_t, std::int32_t or std::uint8_t.
/// The same content gives the same bytes, in HDF5's default format, which all tools read. A name
/// given twice or an object that is missing is a programming error (std::logic_error). To be used
/// by one thread at a time.
class Hdf5Writer {
 public:
  Hdf5Writer();
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// Rows of `columns` values each; one column makes a one-dimensional dataset.
  template <class Number>
  void write(const std::string& name, std::span<const Number> values, std::size_t columns = 1);
  /// Rows of `columns` values from as long columns, or fewer: the rest is 0.
  void write_columns(const std::string& name, std::span<const std::span<const double>> given,
                     std::size_t columns);
  void write_text(const std::string& name, const std::string& text);
  void create_group(const std::string& name);

  /// `object` is a dataset or group that exists.
  void write_attribute(const std::string& object, const std::string& name, const std::string& text);
  void write_attribute(const std::string& object, const std::string& name,
                       std::span<const std::int64_t> values);

  /// The whole file as written so far; no copy: valid until more is written, or the writer goes.
  std::string_view bytes() const;

 private:
  std::int64_t create_dataset(const std::string& name, std::int64_t type, std::int64_t space);

  std::int64_t id_;
};

/// An HDF5 file to read from. What is not there, or cannot be read, throws InputError with HDF5's
/// reason. To be used by one thread at a time.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::filesystem::path file);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// All values, row by row.
  template <class Number>
  std::vector<Number> read(const std::string& name) const;
  std::string read_text(const std::string& name) const;
  std::string read_text_attribute(const std::string& object, const std::string& name) const;

  /// Whether a dataset holds whole numbers rather than real ones.
  bool holds_integers(const std::string& name) const;
  /// Names of all datasets below a group, relative to it, in alphabetical order.
  std::vector<std::string> datasets(const std::string& group) const;

 private:
  std::int64_t open_dataset(const std::string& name) const;
  [[noreturn]] void fail(const std::string& doing) const;

  std::filesystem::path file_;
  std::int64_t id_;
};

}  // namespace perifrac
