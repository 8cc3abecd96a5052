#pragma once

#include <map>
#include <string>
#include <string_view>

#include "proto/spec/input_error.h"

namespace google::protobuf {
class FieldDescriptor;
class Message;
}  // namespace google::protobuf

/// Private to proto/text: validation of user files, for readers of all schemas.
namespace tandem::text {

/// Location and text of a key's value.
struct SourceLocation {
  int line = 0;
  int column = 0;
  std::string value;
};

/// A number in short decimal form, at most 12 digits: 0.02, 400, 1e6, 5.5e-5, inf.
[[nodiscard]] std::string number_text(double value);

/// `parent.field` or `field`; `parent.field[3]` for repeated fields.
[[nodiscard]] std::string child_path(std::string_view parent, std::string_view field, int index = -1);

/// Collects all errors of one file and the location of each key.
/// Use: the reader records locations and syntax errors. check_limits checks single values against the (limit) options
/// of the schema. The caller adds its own rules that need several values. `take` returns all errors in file order.
class MessageValidator {
 public:
  /// Errors beyond this number are counted, not listed.
  static constexpr std::size_t kErrorsMax = 200;

  explicit MessageValidator(std::string_view file) : file_(file) {}

  void record_location(std::string path, SourceLocation place) {
    locations_.insert_or_assign(std::move(path), std::move(place));
  }
  [[nodiscard]] bool is_set(std::string_view path) const { return locations_.find(path) != locations_.end(); }
  /// Location of `path`, else of the nearest enclosing key; line 0 if none was written.
  [[nodiscard]] SourceLocation location(std::string_view path) const;

  /// Adds an error at the location of `path`. It shows the value as written, or `value` if none was written (a
  /// default).
  void error(std::string_view path, std::string message, std::string_view value = {});
  void error_at(const SourceLocation& place, std::string_view path, std::string message);

  /// Checks every value of `message` against the limits of its schema. Values are finite and in range, enumerators
  /// known, names well-formed, mandatory fields present, and item counts within their maximum.
  void check_limits(const google::protobuf::Message& message, const std::string& path = {});

  /// Checks one number against the limits of `field`. For schemas whose limits are options of the enclosing message
  /// field.
  void check_number(const google::protobuf::FieldDescriptor& field, double value, std::string_view path);

  [[nodiscard]] bool ok() const noexcept { return errors_.empty(); }
  /// Returns all errors in file order, those without a location last. Leaves the validator empty.
  [[nodiscard]] InputErrors take();

 private:
  std::string file_;
  std::map<std::string, SourceLocation, std::less<>> locations_;
  InputErrors errors_;
  std::size_t unlisted_ = 0;
};

/// All set fields, one per line: path, value and unit in aligned columns.
[[nodiscard]] std::string listing(const google::protobuf::Message& message);

}  // namespace tandem::text
