"""The pairs of benches/grade.rs through SymPy and giac, beside what carom takes for them in the same run.

By hand: python3 benches/peers.py [giac]; the argument says where giac is, if it is not on the path.
"""
import re, shutil, statistics, subprocess, sys, time
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


def giac_pair(program, a, b, rounds=40):
    """Seconds of one simplification, start-up left out, and whether it gives 0."""
    names = sorted(set(re.findall(r"[a-zA-Z]\w*", a + " " + b)) - {"sin", "cos", "sqrt"})
    # e and i have a meaning of their own there.
    renamed = {n: f"{n}_" if n in ("e", "i") else n for n in names}
    text = re.sub(r"[a-zA-Z]\w*", lambda m: renamed.get(m[0], m[0]), f"simplify(({a})-({b}))")
    assumed = "".join(f"assume({n}>0):;\n" for n in renamed.values())

    def run(times):
        start = time.perf_counter()
        out = subprocess.run([program], input=assumed + (text + "\n") * times, capture_output=True, text=True, timeout=60)
        return time.perf_counter() - start, out.stdout

    few, out = min((run(1) for _ in range(3)), key=lambda r: r[0])
    many, _ = min((run(1 + rounds) for _ in range(3)), key=lambda r: r[0])
    lines = [re.sub(r"^(\d+>>\s*)+", "", line).strip() for line in out.splitlines()]
    values = [line for line in lines if line and not line.startswith("//")]
    return max(many - few, 0) / rounds, values[-1] == "0"


def carom_times():
    """Microseconds by class, from the bench itself: equal pairs with the identity proved, different ones told apart."""
    command = ["cargo", "bench", "--quiet", "--bench", "grade", "--", "stages"]
    out = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    times = {}
    for row in out.splitlines()[1:]:
        name, *cells = row.split()
        times[name] = {"equal": float(cells[12]), "different": float(cells[10])}
    return times


giac = shutil.which(sys.argv[1] if len(sys.argv) > 1 else "giac")
carom = carom_times()
print(f"{'class':15} {'pair':10} {'carom us':>9}  SymPy {sympy.__version__}: us, times carom, says   giac: us, times carom, says")
for name, expected, equal, other in PAIRS:
    for kind, answer in (("equal", equal), ("different", other)):
        ours = carom[name][kind]
        row = f"{name:15} {kind:10} {ours:9.2f}"
        for peer in ("SymPy", "giac"):
            try:
                if peer == "SymPy":
                    seconds, verdict = timed(sympy_pair, plain(expected), plain(answer))
                elif giac:
                    seconds, verdict = giac_pair(giac, plain(expected), plain(answer))
                else:
                    row += "   not installed"
                    continue
                said = "equal" if verdict else "different"
                row += f"  {seconds * 1e6:10.0f} {seconds * 1e6 / ours:9.0f}x {said:9}"
            except Exception as trouble:
                row += f"  {type(trouble).__name__}: {trouble}"
        print(row, flush=True)
