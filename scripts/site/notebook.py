"""A notebook as a page of Markdown: cells, what they print, and pictures."""

import json


def page_of(text):
    """The page of the text of a notebook."""
    parts = []
    for cell in json.loads(text)["cells"]:
        source = "".join(cell["source"])
        parts.append(source if cell["cell_type"] == "markdown" else f"```python\n{source}\n```")
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            if "image/png" in data:
                parts.append(f"![what the cell shows](data:image/png;base64,{''.join(data['image/png'].split())})")
            else:
                said = "".join(output.get("text") or data["text/plain"])
                parts.append(f"```text\n{said.rstrip()}\n```")
    return "\n\n".join(parts) + "\n"
