# Writes the templates as a C++ source: cmake -DFOLDER=... -DFILES=a/b.yaml,... -DOUTPUT=... -P embed.cmake
string(REPLACE "," ";" files "${FILES}")
set(entries "")
foreach(file ${files})
  file(READ ${FOLDER}/${file} text)
  get_filename_component(kind ${file} DIRECTORY)
  get_filename_component(name ${file} NAME)
  string(APPEND entries "    {\"${kind}\", \"${name}\", R\"yaml(${text})yaml\"},\n")
endforeach()
file(WRITE ${OUTPUT}
"// Generated from pipeline/templates.
#include \"pipeline/templates/template_file.h\"

namespace blocklift::pipeline {

const std::vector<TemplateFile>& template_files() {
  static const std::vector<TemplateFile> files = {
${entries}  };
  return files;
}

}  // namespace blocklift::pipeline
")
