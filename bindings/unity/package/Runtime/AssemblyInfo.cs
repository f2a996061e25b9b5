// SPDX-License-Identifier: MIT
using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Knurl.Haptics.Editor")]
[assembly: InternalsVisibleTo("Knurl.Haptics.glTFast")]
[assembly: InternalsVisibleTo("Knurl.Haptics.UnityGLTF")]
[assembly: InternalsVisibleTo("Knurl.Haptics.Tests")]
[assembly: InternalsVisibleTo("Knurl.Haptics.Editor.Tests")]
