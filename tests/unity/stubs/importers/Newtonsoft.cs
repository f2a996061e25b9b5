// Stands in for Json.NET: a value that remembers its JSON. Its real one is Unity's package
// com.unity.nuget.newtonsoft-json. SPDX-License-Identifier: MIT
namespace Newtonsoft.Json
{
    public enum Formatting { None, Indented }

    namespace Linq
    {
        public sealed class JToken
        {
            readonly string json;
            public JToken(string json) { this.json = json; }
            public string ToString(Formatting formatting, params object[] converters) { return json; }
        }
    }
}
