#pragma once

#include <map>
#include <string>
#include <string_view>

#include "proto/input_error.h"

namespace google::protobuf {
class FieldDescriptor;
class Message;
}

/// Private to proto/*.cpp: what every reader of a person's file needs, whatever the schema.
namespace tandem::text {

/// Where a key's value was written, and how.
struct Place {
  int line = 0;
  int column = 0;
  std::string value;
};

/// A number as people write it, at most 12 digits: 0.02, 400, 1e6, 5.5e-5, inf.
[[nodiscard]] std::string number_text(double value);

/// `parent.field` or `field`; `parent.field[3]` for repeated fields.
[[nodiscard]] std::string child_path(std::string_view parent, std::string_view field, int index = -1);

/// Collects every mistake of one file and knows where each key was written.
/// Use: reader notes places and syntax errors; check_limits judges single values by the (limit) options of the schema;
/// the caller's own rules add what needs several values; `take` hands all over in file order.
class Checker {
 public:
  /// More mistakes than this are counted, not listed.
  static constexpr std::size_t kErrorsMax = 200;

  explicit Checker(std::string_view file) : file_(file) {}

  void note(std::string path, Place place) { places_.insert_or_assign(std::move(path), std::move(place)); }
  [[nodiscard]] bool written(std::string_view path) const { return places_.find(path) != places_.end(); }
  /// Of `path`, else of the nearest key around it; line 0 if none was written.
  [[nodiscard]] Place place(std::string_view path) const;

  /// A mistake at the place of `path`. The value is as written; `value` is shown when it was not (a default).
  void error(std::string_view path, std::string message, std::string_view value = {});
  void error_at(const Place& place, std::string_view path, std::string message);

  /// Every value of `message` against the limits its schema states: finite, in range, known enumerators, names of legal
  /// form, mandatory fields written, not too many items.
  void check_limits(const google::protobuf::Message& message, const std::string& path = {});

  /// One number against the limits stated at `field`, for schemas whose limits stand at the message that holds the number.
  void check_number(const google::protobuf::FieldDescriptor& field, double value, std::string_view path);

  [[nodiscard]] bool ok() const noexcept { return errors_.empty(); }
  /// All mistakes, in file order, those without a place last. Leaves the checker empty.
  [[nodiscard]] InputErrors take();

 private:
  std::string file_;
  std::map<std::string, Place, std::less<>> places_;
  InputErrors errors_;
  std::size_t unlisted_ = 0;
};

/// Every field that is set, one per line: path, value, unit in aligned columns.
[[nodiscard]] std::string listing(const google::protobuf::Message& message);

}  // namespace tandem::text
