#pragma once

#include <utility>

#include "server/export/io/hdf5_library.h"

namespace tandem::server {

/// Returns the library. @pre it is loaded: a file was opened
inline const Hdf5Library& h5() { return *Hdf5Library::load(); }

/// Owns an identifier of libhdf5.
class Hdf5Id {
 public:
  Hdf5Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Id() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Id(const Hdf5Id&) = delete;
  Hdf5Id& operator=(const Hdf5Id&) = delete;
  [[nodiscard]] hid_t get() const noexcept { return id_; }
  [[nodiscard]] bool good() const noexcept { return id_ >= 0; }
  /// Closes now. @return whether that failed
  [[nodiscard]] bool close_fails() { return close_(std::exchange(id_, -1)) < 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

}  // namespace tandem::server
