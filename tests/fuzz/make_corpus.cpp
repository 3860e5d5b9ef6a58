// Writes the samples into the folders of a corpus: make_corpus FOLDER. Keeps the inputs found by
// fuzzers.

#include "fuzz/samples.h"

#include <filesystem>
#include <fstream>

int main(int count, char** arguments)
{
    if (count != 2)
        return 1;
    for (const sward::fuzz::Sample& sample : sward::fuzz::samples()) {
        const std::filesystem::path folder = std::filesystem::path(arguments[1]) / sample.entry;
        std::filesystem::create_directories(folder);
        std::ofstream(folder / sample.name, std::ios::binary) << sample.bytes;
    }
}
