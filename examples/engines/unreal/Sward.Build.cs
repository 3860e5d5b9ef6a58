// In Source/YourGame/ThirdParty/Sward: include/ and lib/ of an installed Sward, or of its zip for Windows.
using System.IO;
using UnrealBuildTool;

public class Sward : ModuleRules
{
    public Sward(ReadOnlyTargetRules Target) : base(Target)
    {
        Type = ModuleType.External;
        PublicSystemIncludePaths.Add(Path.Combine(ModuleDirectory, "include"));
        bool isWindows = Target.Platform == UnrealTargetPlatform.Win64;
        string library = Path.Combine(ModuleDirectory, "lib", isWindows ? "sward.lib" : "libsward.so");
        PublicAdditionalLibraries.Add(library);
        RuntimeDependencies.Add(isWindows ? "$(BinaryOutputDir)/sward.dll" : "$(BinaryOutputDir)/libsward.so.0.1",
            Path.Combine(ModuleDirectory, "lib", isWindows ? "sward.dll" : "libsward.so.0.1"));
    }
}
