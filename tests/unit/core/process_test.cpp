// Laws of core/process. tests/windows/system_calls.cpp has them for Windows.
#include "core/error.h"
#include "core/process/arriving_bytes.h"
#include "core/process/child_process.h"
#include "core/process/process_id.h"
#include "core/process/program_path.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

namespace sward {
namespace {

// Waits for the end. What it has said meanwhile goes into `said`.
ChildProcess::End endOf(ChildProcess& child, std::string& said)
{
    for (;;) {
        const std::optional<ChildProcess::End> end = child.end();
        said += child.said();
        if (end)
            return *end;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

TEST(ChildProcess, TellsWhatItSaysAndHowItEnds)
{
    ChildProcess child({"/bin/sh", "-c", "printf '%s|' \"$@\"; echo error >&2; exit 7", "name",
                        "a \xc3\xa4", "\"", "\\", ""});
    std::string said;
    const ChildProcess::End end = endOf(child, said);
    EXPECT_EQ(end.exitCode, 7);
    EXPECT_EQ(said, "a \xc3\xa4|\"|\\||error\n");
    EXPECT_EQ(child.end()->exitCode, 7) << "a second time";
}

TEST(ChildProcess, EndsWhenAskedTo)
{
    ChildProcess child({"/bin/sh", "-c", "echo begun; exec sleep 1000"});
    std::string said;
    while (said.empty())
        said = child.said();
    EXPECT_FALSE(child.end().has_value());
    child.askToEnd();
    const ChildProcess::End end = endOf(child, said);
    EXPECT_FALSE(end.exitCode.has_value());
    EXPECT_EQ(end.reason, "signal 15 (Terminated)");
}

TEST(ChildProcess, EndsWithItsObject)
{
    std::string id;
    {
        ChildProcess child({"/bin/sh", "-c", "echo $$; exec sleep 1000"});
        while (!id.ends_with('\n'))
            id += child.said();
    }
    EXPECT_NE(::access(("/proc/" + id.substr(0, id.size() - 1)).c_str(), F_OK), 0);
}

TEST(ChildProcess, RefusesAProgramThatIsMissing)
{
    try {
        ChildProcess child({"/no/such/program"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::runtime);
        EXPECT_STREQ(error.what(), "/no/such/program: cannot be run: No such file or directory");
    }
}

TEST(ChildProcess, TakesBytesAndAnswers)
{
    ChildProcess child({"/bin/cat"}, ChildTalk::answers);
    const std::string bytes(std::size_t(3) << 20, 'x');
    std::string_view rest = bytes;
    std::string answered;
    while (!rest.empty()) {
        rest.remove_prefix(child.offer(rest)); // never waits, although cat does
        answered += child.answered().value();
    }
    child.endInput();
    while (const std::optional<std::string> more = child.answered())
        answered += *more;
    EXPECT_TRUE(answered == bytes);
    EXPECT_EQ(child.endWithin(std::chrono::seconds(60))->exitCode, 0);
}

TEST(ChildProcess, ThatReadsNoMoreIsNoticed)
{
    ChildProcess child({"/bin/sh", "-c", "read line; echo \"$line\"; exit 3"}, ChildTalk::takes);
    EXPECT_TRUE(child.give("a line\n"));
    EXPECT_EQ(child.endWithin(std::chrono::seconds(60))->exitCode, 3);
    EXPECT_EQ(child.said(), "a line\n");
    EXPECT_FALSE(child.give("more"));
    EXPECT_EQ(child.offer("more"), 0u);
    EXPECT_FALSE(
        ChildProcess({"/bin/sleep", "1000"}).endWithin(std::chrono::milliseconds(1)).has_value());
}

TEST(ChildProcess, IsRunToItsEnd)
{
    // More than a pipe holds.
    const ChildResult result = runChild({"/bin/sh", "-c", "head -c 300000 /dev/zero; exit 5"});
    EXPECT_EQ(result.said.size(), 300000u);
    EXPECT_EQ(result.end.exitCode, 5);
}

TEST(ProcessName, TellsAProcessFromOneThatHasItsNumberNow)
{
    ProcessName own = ProcessName::own();
    EXPECT_TRUE(own.isAlive());
    own.start += "1";
    EXPECT_FALSE(own.isAlive());
    own = ProcessName::own();
    own.boot = "another";
    EXPECT_FALSE(own.isAlive());
}

TEST(ArrivingBytes, ComeAsTheyArrive)
{
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    std::array<char, 8> bytes{};
    constexpr std::chrono::milliseconds none{0};
    EXPECT_FALSE(readArriving(ends[0], bytes, none).has_value());
    ASSERT_EQ(::write(ends[1], "ab", 2), 2);
    EXPECT_EQ(readArriving(ends[0], bytes, none), 2u);
    EXPECT_EQ(bytes[1], 'b');
    ::close(ends[1]);
    EXPECT_EQ(readArriving(ends[0], bytes, none), 0u) << "the end";
    ::close(ends[0]);
    EXPECT_THROW(readArriving(ends[0], bytes, none), Error);
}

TEST(ProgramPath, IsThatOfThisProgram)
{
    EXPECT_TRUE(isProgram(programPath()));
    EXPECT_FALSE(isProgram(programPath().parent_path()));
    EXPECT_EQ(programFile("a"), "a");
    EXPECT_TRUE(isProgram(programNamed("sh")));
    EXPECT_TRUE(programNamed("no-such-program").empty());
    EXPECT_EQ(processId(), static_cast<std::uint64_t>(::getpid()));
}

} // namespace
} // namespace sward
