# cmake -DOUT=<file.cpp> -DDIR=<filters> -P EmbedStyles.cmake
# Puts the style files into the program, so that it needs no data files beside it.
file(GLOB styles "${DIR}/*.toml")
list(SORT styles)
set(rows "")
foreach(style IN LISTS styles)
  get_filename_component(name "${style}" NAME_WE)
  file(READ "${style}" text)
  string(APPEND rows "        {\"${name}\", R\"__style(${text})__style\"},\n")
endforeach()
file(WRITE "${OUT}" "#include \"pipeline/style_file.h\"

namespace dstylize {
const std::vector<BuiltinStyle>& builtin_styles() {
    static const std::vector<BuiltinStyle> kStyles{
${rows}    };
    return kStyles;
}
}  // namespace dstylize
")
