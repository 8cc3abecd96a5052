#include "tests/install/elf_file.h"

#include <elf.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace tandem::test {
namespace {

constexpr std::string_view kEndbr64{"\xf3\x0f\x1e\xfa", 4};

}  // namespace

template <class T>
T ElfFile::at(std::uint64_t offset) const {
  if (offset > bytes_.size() || bytes_.size() - offset < sizeof(T))
    throw std::runtime_error("an offset beyond the end of the file");
  T value;
  std::memcpy(&value, bytes_.data() + offset, sizeof value);
  return value;
}

std::string ElfFile::text_at(std::uint64_t offset) const {
  if (offset >= bytes_.size()) throw std::runtime_error("a name beyond the end of the file");
  return bytes_.c_str() + offset;
}

std::uint64_t ElfFile::offset_of(std::uint64_t address) const {
  for (const Segment& s : segments_)
    if (address >= s.address && address - s.address < s.size) return s.offset + (address - s.address);
  throw std::runtime_error("an address that no segment holds");
}

ElfFile::ElfFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  bytes_.assign(std::istreambuf_iterator<char>(file), {});
  const auto header = at<Elf64_Ehdr>(0);
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_ident[EI_CLASS] != ELFCLASS64)
    throw std::runtime_error(path.string() + " is no 64-bit ELF file");
  x86_64_ = header.e_machine == EM_X86_64;
  read_segments();
}

void ElfFile::read_segments() {
  const auto header = at<Elf64_Ehdr>(0);
  std::vector<Elf64_Phdr> all;
  for (unsigned i = 0; i < header.e_phnum; ++i) all.push_back(at<Elf64_Phdr>(header.e_phoff + i * sizeof(Elf64_Phdr)));
  for (const Elf64_Phdr& p : all) {
    if (p.p_type == PT_LOAD) {
      segments_.push_back({p.p_vaddr, p.p_offset, p.p_filesz, (p.p_flags & PF_X) != 0});
      writable_code_ = writable_code_ || ((p.p_flags & PF_X) != 0 && (p.p_flags & PF_W) != 0);
    }
    relro_ = relro_ || p.p_type == PT_GNU_RELRO;
    if (p.p_type == PT_GNU_STACK) executable_stack_ = (p.p_flags & PF_X) != 0;
  }
  for (const Elf64_Phdr& p : all) {
    if (p.p_type == PT_DYNAMIC) read_dynamic(p.p_offset, p.p_filesz);
    if (p.p_type == PT_GNU_PROPERTY) read_notes(p.p_offset, p.p_filesz);
  }
}

void ElfFile::read_dynamic(std::uint64_t offset, std::uint64_t size) {
  std::uint64_t names = 0, symbols = 0, symbols_end = 0, relocations = 0, relocations_size = 0;
  std::vector<std::uint64_t> needed;
  for (std::uint64_t i = 0; i < size; i += sizeof(Elf64_Dyn)) {
    const auto d = at<Elf64_Dyn>(offset + i);
    switch (d.d_tag) {
      case DT_STRTAB:
        names = offset_of(d.d_un.d_ptr);
        break;
      case DT_SYMTAB:
        symbols = offset_of(d.d_un.d_ptr);
        break;
      case DT_NEEDED:
        needed.push_back(d.d_un.d_val);
        break;
      case DT_RELA:
        relocations = offset_of(d.d_un.d_ptr);
        break;
      case DT_RELASZ:
        relocations_size = d.d_un.d_val;
        break;
      case DT_BIND_NOW:
        bind_now_ = true;
        break;
      case DT_FLAGS:
        bind_now_ = bind_now_ || (d.d_un.d_val & DF_BIND_NOW) != 0;
        break;
      case DT_FLAGS_1:
        bind_now_ = bind_now_ || (d.d_un.d_val & DF_1_NOW) != 0;
        position_independent_ = (d.d_un.d_val & DF_1_PIE) != 0 && at<Elf64_Ehdr>(0).e_type == ET_DYN;
        break;
      default:
        break;
    }
  }
  for (const std::uint64_t name : needed) libraries_.push_back(text_at(names + name));
  // The symbol table does not state its length; its section, which stripping keeps, does.
  const auto header = at<Elf64_Ehdr>(0);
  for (unsigned i = 0; i < header.e_shnum; ++i) {
    const auto section = at<Elf64_Shdr>(header.e_shoff + i * sizeof(Elf64_Shdr));
    if (section.sh_type == SHT_DYNSYM) symbols_end = section.sh_offset + section.sh_size;
  }
  for (std::uint64_t at_symbol = symbols; at_symbol + sizeof(Elf64_Sym) <= symbols_end;
       at_symbol += sizeof(Elf64_Sym)) {
    const auto symbol = at<Elf64_Sym>(at_symbol);
    if (symbol.st_shndx == SHN_UNDEF) imports_.insert(text_at(names + symbol.st_name));
  }
  for (std::uint64_t i = 0; i < relocations_size; i += sizeof(Elf64_Rela)) {
    const auto r = at<Elf64_Rela>(relocations + i);
    if (x86_64_ && ELF64_R_TYPE(r.r_info) == R_X86_64_RELATIVE) add_target(static_cast<std::uint64_t>(r.r_addend));
  }
}

void ElfFile::read_notes(std::uint64_t offset, std::uint64_t size) {
  const auto note = at<Elf64_Nhdr>(offset);
  if (note.n_type != NT_GNU_PROPERTY_TYPE_0) return;
  std::uint64_t property = offset + sizeof note + ((note.n_namesz + 3) & ~3ULL);
  while (property + 8 <= offset + size) {
    const auto type = at<std::uint32_t>(property), length = at<std::uint32_t>(property + 4);
    if (type == GNU_PROPERTY_X86_FEATURE_1_AND) {
      const auto features = at<std::uint32_t>(property + 8);
      ibt_ = (features & GNU_PROPERTY_X86_FEATURE_1_IBT) != 0;
      shadow_stack_ = (features & GNU_PROPERTY_X86_FEATURE_1_SHSTK) != 0;
    }
    property += 8 + ((length + 7ULL) & ~7ULL);
  }
}

void ElfFile::add_target(std::uint64_t address) {
  for (const Segment& s : segments_)
    if (s.code && address >= s.address && address - s.address < s.size)
      targets_.push_back({address, bytes_.compare(s.offset + (address - s.address), kEndbr64.size(), kEndbr64) == 0});
}

bool ElfFile::code_holds(const std::string& bytes) const {
  for (const Segment& s : segments_)
    if (s.code && bytes_.substr(s.offset, s.size).find(bytes) != std::string::npos) return true;
  return false;
}

}  // namespace tandem::test
