# Writes OUT, a C++ source with the program FILE: cmake -DFILE=... -DOUT=... -P embed.cmake
file(READ ${FILE} bytes HEX)
string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
file(WRITE ${OUT} "#include \"server/export/app/parquet_program.h\"

namespace tandem::server {
namespace {

constexpr char kProgram[] = \"${bytes}\";

}  // namespace

std::string_view parquet_program() noexcept { return {kProgram, sizeof kProgram - 1}; }

}  // namespace tandem::server
")
