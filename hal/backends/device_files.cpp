#include "hal/backends/device_files.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "common/base/hex.h"
#include "common/base/raw_bytes.h"
#include "common/transport/digest.h"
#include "proto/io/scene_file.h"
#include "proto/text/device_text.h"

namespace tandem::hal {
namespace {

DeviceError all_of(const InputErrors& errors) {
  std::string lines = to_text(errors);
  if (!lines.empty()) lines.pop_back();  // removes the last line feed
  return {Errc::kUnsupported, std::move(lines)};
}

}  // namespace

Result<DeviceFileSpec> parse_device_file(std::string_view text, std::string_view name) {
  auto spec = parse_device_text(text, name);
  if (!spec) return std::unexpected(all_of(spec.error()));
  return std::move(*spec);
}

Result<DeviceFileSpec> load_device_file(const std::string& file) {
  const auto text = read_text_file(file);
  return text ? parse_device_file(*text, file) : std::unexpected(all_of(text.error()));
}

Result<FalconSpec> load_falcon_file(const std::string& file) {
  auto spec = load_device_file(file);
  if (!spec) return std::unexpected(std::move(spec.error()));
  if (!spec->falcon) return std::unexpected(wrong_device_kind(file, "falcon"));
  if (const auto force = FalconForce::from(*spec->falcon); !force)
    return std::unexpected(DeviceError{
        Errc::kUnsupported, file + ":" + std::to_string(force.error().line) + ": falcon: " + force.error().text});
  return std::move(*spec->falcon);
}

DeviceError wrong_device_kind(const std::string& file, const std::string& kind) {
  return {Errc::kUnsupported, file + ":1: does not describe a " + kind + ": write " + kind + " { ... }"};
}

Result<DeviceFileSpec> parse_shipped_preset(const EmbeddedFile& preset) {
  return parse_device_file(preset.text, preset.name);
}

Result<FalconFirmware> load_firmware(const std::string& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string bytes;
  if (in) {
    // One byte more than the largest image: check_firmware then reports that it is too long.
    bytes.resize(kFirmwareMax + 1);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
  }
  if (!in.is_open() || in.bad()) {
    const int code = errno != 0 ? errno : EIO;
    return std::unexpected(DeviceError{
        Errc::kUnsupported, "firmware: " + file + ": cannot be read: " + std::generic_category().message(code)});
  }
  FalconFirmware firmware;
  firmware.file = file;
  firmware.image.assign(bytes_of(bytes).begin(), bytes_of(bytes).end());
  firmware.sha256 = to_hex(transport::sha256(bytes_of(bytes)));
  return firmware;
}

}  // namespace tandem::hal
