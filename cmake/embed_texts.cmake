# Writes texts into a C++ source, so that a program needs no files of them: a function that returns name and content of
# each, the name being the path below the folder of its set. Run in the build, by add_custom_command:
#
#   cmake -DOUTPUT=... -DHEADER=WHERE_IT_IS_DECLARED -DNAMESPACE=gyre::x -DFUNCTION=texts -DFOLDERS=a,b -DFILES=a/1,b/2 -P THIS

string(REPLACE "," ";" FOLDERS "${FOLDERS}")
string(REPLACE "," ";" FILES "${FILES}")
set(rows "")
foreach(file IN LISTS FILES)
  file(READ ${file} content)
  set(name ${file})
  foreach(folder IN LISTS FOLDERS)
    string(REPLACE "${folder}/" "" name ${name})
  endforeach()
  string(APPEND rows "      {\"${name}\", R\"embedded(${content})embedded\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

namespace ${NAMESPACE} {

const std::vector<EmbeddedText>& ${FUNCTION}() {
  static const std::vector<EmbeddedText> kTexts{
${rows}  };
  return kTexts;
}

}  // namespace ${NAMESPACE}
")
