# Run as a script: cmake -DINPUT=file -DOUTPUT=file.cpp -DFUNCTION=name -DHEADER=path -P EmbedFile.cmake
# Writes a C++ source whose function returns the bytes of the file.
file(READ "${INPUT}" hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
file(WRITE "${OUTPUT}" "#include \"${HEADER}\"
namespace lucarne {
namespace {
constexpr std::uint8_t kBytes[] = {${bytes}};
}
std::span<const std::uint8_t> ${FUNCTION}() { return kBytes; }
}  // namespace lucarne
")
