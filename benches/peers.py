"""The pairs of benches/grade.rs through SymPy, and giac where it is installed. Run by hand: python3 benches/peers.py"""
import re, shutil, statistics, subprocess, time
import sympy
from sympy.parsing.sympy_parser import parse_expr

SOURCE = open("benches/grade.rs", encoding="utf-8").read()
TABLE = SOURCE[SOURCE.index("const PAIRS"):SOURCE.index("const CLASSES")]
CELLS = re.findall(r'"((?:[^"\\]|\\.)*)"', TABLE)
PAIRS = [CELLS[i:i + 4] for i in range(0, len(CELLS), 4)]


def plain(text):
    """The notation of computer algebra: every product with its sign."""
    text = text.replace("θ", "theta").replace("α", "alpha").replace("β", "beta").replace("²", "^2")
    text = re.sub(r"sin(theta|alpha|beta)\b", r"sin(\1)", text)
    text = re.sub(r"(\d|\)|[a-zA-Z]\d?)\s+(?=[\w(])", r"\1*", text)
    text = re.sub(r"\)\s*\(", ")*(", text)
    text = re.sub(r"(\d)(?=[a-zA-Z(])", r"\1*", text) if "1*" not in text else text
    text = re.sub(r"\b([mxyusw])\*(\d)", r"\1\2", text)
    return text.replace("sin*(", "sin(").replace("cos*(", "cos(").replace("sqrt*(", "sqrt(")


def sympy_pair(a, b):
    names = set(re.findall(r"[a-zA-Z]\w*", a + " " + b)) - {"sin", "cos", "sqrt"}
    local = {n: sympy.Symbol(n, positive=True) for n in names}
    read = lambda t: parse_expr(t.replace("^", "**"), local_dict=local)
    return sympy.simplify(read(a) - read(b)) == 0


def timed(f, *args, rounds=5):
    times = []
    for _ in range(rounds):
        sympy.core.cache.clear_cache()
        start = time.perf_counter()
        result = f(*args)
        times.append(time.perf_counter() - start)
    return statistics.median(times), result


def giac_pair(a, b):
    out = subprocess.run(["giac", f"simplify(({a})-({b}))"], capture_output=True, text=True, timeout=60)
    return out.stdout.strip().splitlines()[-1] == "0"


for name, expected, equal, other in PAIRS:
    for kind, answer in (("equal", equal), ("different", other)):
        try:
            seconds, verdict = timed(sympy_pair, plain(expected), plain(answer))
            print(f"SymPy {sympy.__version__}  {name:15} {kind:10} {seconds * 1e3:9.2f} ms  equal: {verdict}")
        except Exception as trouble:
            print(f"SymPy {sympy.__version__}  {name:15} {kind:10} {type(trouble).__name__}: {trouble}")
        if shutil.which("giac"):
            seconds, verdict = timed(giac_pair, plain(expected), plain(answer))
            print(f"giac (with start-up)  {name:15} {kind:10} {seconds * 1e3:9.2f} ms  equal: {verdict}")
