// Reads a field of grass (.sward) by Sward's C interface. Knows nothing of Unity: any C# program may use it.
// Needs libsward.so (Linux) or sward.dll (64-bit Windows) where the program looks for libraries.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Sward
{
    /// A row of a field: a blade, the stalk of a compound plant, or a ribbon on a stalk (sward_blade of c/field.h).
    [StructLayout(LayoutKind.Sequential)]
    public struct Blade
    {
        public double X, Y, Z;             // [m] root, world
        public float UpX, UpY, UpZ;        // unit
        public float Facing;               // [rad]
        public float Height, Width;        // [m]
        public float Stiffness, Exposure;  // 0 to 1
        public float Red, Green, Blue;     // colour of the ground, sRGB, 0 to 1
        public uint Species, Clump, Group; // group: number of the blade's patch
        public uint Ribbon;                // 0: a blade or a stalk; else a leaf or a petal on the stalk before it
        public ulong Id;
    }

    /// sward_field_info of c/field.h.
    [StructLayout(LayoutKind.Sequential)]
    public struct FieldInfo
    {
        public ulong BladeCount, PatchCount;
        public uint SpeciesCount;
        public double OriginX, OriginY, OriginZ;      // [m] world = origin + position
        public float LowX, LowY, LowZ;                // [m] box of all that is seen, relative to the origin
        public float HighX, HighY, HighZ;
    }

    /// A field file, mapped and verified. Every fault of the file is an Exception with Sward's message.
    public sealed class Field : IDisposable
    {
        IntPtr handle;

        public FieldInfo Info { get; private set; }

        public Field(string path)
        {
            Check(sward_field_open(Encoding.UTF8.GetBytes(path + "\0"), out handle));
            FieldInfo info;
            Check(sward_field_get_info(handle, out info));
            Info = info;
        }

        /// Rows from `first` on; as many as `rows` has room for.
        public void Read(ulong first, Blade[] rows)
        {
            Check(sward_field_read_blades(handle, first, (ulong)rows.LongLength, rows));
        }

        public string SpeciesName(uint species)
        {
            return Text(sward_field_species_name(handle, species));
        }

        /// Quaternion x, y, z, w that turns +Y to the up-vector and +Z to the side to which the blade leans, in Sward's
        /// right-handed axes.
        public static void Rotation(ref Blade blade, float[] rotation)
        {
            sward_blade_rotation(ref blade, rotation);
        }

        public void Dispose()
        {
            sward_field_destroy(handle);
            handle = IntPtr.Zero;
        }

        static void Check(int status)
        {
            if (status != 0)
                throw new InvalidOperationException(Text(sward_last_error()));
        }

        static string Text(IntPtr text)
        {
            if (text == IntPtr.Zero)
                return "";
            int length = 0;
            while (Marshal.ReadByte(text, length) != 0)
                ++length;
            var bytes = new byte[length];
            Marshal.Copy(text, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }

        const string Library = "sward";
        [DllImport(Library)] static extern int sward_field_open(byte[] path, out IntPtr field);
        [DllImport(Library)] static extern void sward_field_destroy(IntPtr field);
        [DllImport(Library)] static extern int sward_field_get_info(IntPtr field, out FieldInfo info);
        [DllImport(Library)] static extern int sward_field_read_blades(IntPtr field, ulong first, ulong count, [Out] Blade[] rows);
        [DllImport(Library)] static extern void sward_blade_rotation(ref Blade blade, [Out] float[] rotation);
        [DllImport(Library)] static extern IntPtr sward_field_species_name(IntPtr field, uint species);
        [DllImport(Library)] static extern IntPtr sward_last_error();
    }
}
