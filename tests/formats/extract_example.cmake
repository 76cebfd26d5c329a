# Writes the first C++ example of a Markdown page to a file:
#   cmake -D PAGE=... -D OUTPUT=... -P extract_example.cmake
file(READ ${PAGE} text)
string(FIND "${text}" "```cpp\n" begin)
math(EXPR begin "${begin} + 7")
string(SUBSTRING "${text}" ${begin} -1 text)
string(FIND "${text}" "```" end)
string(SUBSTRING "${text}" 0 ${end} text)
file(WRITE ${OUTPUT} "${text}")
