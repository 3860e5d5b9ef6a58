// Draws a field of grass in Unity: add it to an object, name the field and a material with "Enable GPU Instancing".
// A patch of the field is one draw; with distance it draws fewer of its blades, wider. Blades stand still, stalks of
// compound plants are drawn without leaves.
using System.Collections.Generic;
using UnityEngine;
using UnityEngine.Rendering;

namespace Sward
{
    [ExecuteAlways]
    public sealed class SwardGrass : MonoBehaviour
    {
        [Tooltip("A .sward file")] public string path = "Assets/meadow.sward";
        [Tooltip("Any lit material with GPU instancing, drawn from both sides")] public Material material;
        [Tooltip("Up to this distance all blades are drawn [m]"), Range(1, 200)] public float fullDistance = 15;
        [Tooltip("Beyond this distance nothing is drawn [m]"), Range(10, 2000)] public float farthest = 300;
        public ShadowCastingMode shadows = ShadowCastingMode.On;

        sealed class Patch
        {
            public Bounds bounds;
            public Matrix4x4[] blades;
        }

        const int MaxInstances = 511; // of one draw, on every platform
        readonly List<Patch> patches = new List<Patch>();
        Mesh blade;

        void OnEnable()
        {
            blade = BladeMesh();
            patches.Clear();
            using (var field = new Field(path))
            {
                var rows = new Blade[4096];
                var rotation = new float[4];
                var group = new List<Matrix4x4>();
                uint number = 0;
                for (ulong first = 0; first < field.Info.BladeCount; first += 4096)
                {
                    ulong count = System.Math.Min(4096ul, field.Info.BladeCount - first);
                    if (count < 4096)
                        rows = new Blade[count];
                    field.Read(first, rows);
                    for (ulong i = 0; i < count; ++i)
                    {
                        if (rows[i].Group != number || group.Count == MaxInstances)
                            Add(group);
                        number = rows[i].Group;
                        if (rows[i].Ribbon == 0)
                            group.Add(Place(field.Info, ref rows[i], rotation));
                    }
                }
                Add(group);
            }
        }

        // Sward is right-handed, Unity left-handed: x changes its sign, and so do y and z of rotations.
        static Matrix4x4 Place(FieldInfo info, ref Blade row, float[] rotation)
        {
            Field.Rotation(ref row, rotation);
            return Matrix4x4.TRS(
                new Vector3((float)(info.OriginX - row.X), (float)(row.Y - info.OriginY), (float)(row.Z - info.OriginZ)),
                new Quaternion(rotation[0], -rotation[1], -rotation[2], rotation[3]),
                new Vector3(row.Width, row.Height, row.Height));
        }

        void Add(List<Matrix4x4> group)
        {
            if (group.Count == 0)
                return;
            var patch = new Patch { blades = group.ToArray() };
            patch.bounds = new Bounds(patch.blades[0].GetColumn(3), Vector3.zero);
            foreach (Matrix4x4 one in patch.blades)
                patch.bounds.Encapsulate(one.GetColumn(3));
            patch.bounds.Expand(1);
            patches.Add(patch);
            group.Clear();
        }

        void Update()
        {
            Camera camera = Camera.main;
            if (material == null || camera == null)
                return;
            var place = transform.localToWorldMatrix;
            Vector3 eye = transform.InverseTransformPoint(camera.transform.position);
            var frame = new Matrix4x4[MaxInstances];
            foreach (Patch patch in patches)
            {
                float distance = Mathf.Sqrt(patch.bounds.SqrDistance(eye));
                if (distance > farthest)
                    continue;
                // Blades of a patch stand in progressive order: each prefix is evenly spread.
                float share = Mathf.Clamp01(fullDistance / Mathf.Max(distance, 1e-3f));
                int count = Mathf.CeilToInt(share * patch.blades.Length);
                var widen = Matrix4x4.Scale(new Vector3(1 / share, 1, 1));
                for (int i = 0; i < count; ++i)
                    frame[i] = place * patch.blades[i] * widen;
                Graphics.RenderMeshInstanced(
                    new RenderParams(material) { shadowCastingMode = shadows, receiveShadows = true }, blade, 0, frame, count);
            }
        }

        // A ribbon of four segments, 1 high and 1 wide, that leans to +Z.
        static Mesh BladeMesh()
        {
            const int rings = 5;
            var points = new Vector3[2 * rings - 1];
            var normals = new Vector3[points.Length];
            for (int i = 0; i < points.Length; ++i)
            {
                float along = (i / 2) / (rings - 1f);
                float half = i == points.Length - 1 ? 0 : 0.5f * (1 - along * along);
                points[i] = new Vector3(i % 2 == 0 ? -half : half, along, 0.35f * along * along);
                normals[i] = new Vector3(0, -0.7f * along, 1).normalized;
            }
            var corners = new List<int>();
            for (int i = 0; i + 2 < points.Length; ++i)
                corners.AddRange(i % 2 == 0 ? new[] { i, i + 1, i + 2 } : new[] { i, i + 2, i + 1 });
            var mesh = new Mesh { name = "blade" };
            mesh.vertices = points;
            mesh.normals = normals;
            mesh.triangles = corners.ToArray();
            mesh.RecalculateBounds();
            return mesh;
        }
    }
}
