"""What other tools take for the same work, beside carom in the same run. By hand:

    python3 benches/peers.py grade     pairs of formulas of benches/grade.rs through SymPy and giac
    python3 benches/peers.py derive    the linear systems of scenes through FLINT, PARI/GP, SymEngine and SymPy
    python3 benches/peers.py friction  one contact with friction through a step of Pymunk

`pip install sympy python-flint cypari symengine pymunk` brings all but giac; a tool that is missing is told as missing.
"""
import importlib, json, multiprocessing, re, shutil, statistics, subprocess, sys, time
import sympy
from sympy.parsing.sympy_parser import parse_expr


def pairs():
    """The table of benches/grade.rs: class, expected formula, an equal one, another one."""
    source = open("benches/grade.rs", encoding="utf-8").read()
    table = source[source.index("const PAIRS"):source.index("const CLASSES")]
    cells = re.findall(r'"((?:[^"\\]|\\.)*)"', table)
    return [cells[i:i + 4] for i in range(0, len(cells), 4)]


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


def grade():
    giac = shutil.which("giac")
    carom = carom_times()
    print(f"{'class':15} {'pair':10} {'carom us':>9}  SymPy {sympy.__version__}: us, times carom, says   giac: us, times carom, says")
    for name, expected, equal, other in pairs():
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


def medians(bench, *filters):
    """Medians of a bench in microseconds, by the words of its rows from the outermost in."""
    command = ["cargo", "bench", "--quiet", "--bench", bench, "--", *filters]
    out = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    scale = {"ns": 1e-3, "µs": 1, "ms": 1e3, "s": 1e6}
    times, group = {}, ""
    for line in out.splitlines():
        row = re.match(r"[│ ]*[├╰]─ (\S+)", line)
        values = re.findall(r"([\d.]+) (ns|µs|ms|s)\b", line)
        if row and len(values) == 4:
            outer = group if line[0] in "│ " else ""
            times[f"{outer} {row[1]}".strip()] = float(values[2][0]) * scale[values[2][1]]
        elif row:
            group = row[1]
    return times


def chain(n, bent):
    """The chain of benches/derive.rs: n hinged rods, in line or at any angles, struck at the far end."""
    angles = [f"theta{i}" if bent else "0" for i in range(1, n + 1)]
    parameters = {"m": {"unit": "kg"}, "l": {"unit": "m"}, "J": {"unit": "N s"}}
    parameters |= {a: {"unit": "rad", "domain": "real"} for a in angles if bent}
    points, bodies, hinges = {"A0": ["0", "0"]}, {}, {}
    for i, angle in enumerate(angles, 1):
        from_before = lambda distance: {"from": f"A{i - 1}", "distance": distance, "angle": angle}
        points[f"A{i}"] = from_before("l")
        bodies[f"rod{i}"] = {"shape": "rod", "mass": "m", "length": "l", "angle": angle, "center": from_before("l/2")}
        if i > 1:
            hinges[f"H{i}"] = {"bodies": [f"rod{i - 1}", f"rod{i}"], "at": f"A{i - 1}"}
    blow = {"J": {"on": f"rod{n}", "at": f"A{n}", "impulse": ["0", "J"]}}
    return json.dumps({"title": "chain", "source": "bench", "parameters": parameters, "points": points, "bodies": bodies,
                       "hinges": hinges, "blows": blow, "questions": {"omega": {"spin": f"rod{n}"}}})


def system(scene):
    """Matrix and right side of a scene as SymPy expressions in plain symbols: sines and cosines are letters of their own."""
    command = ["target/release/carom", "derive", "-", "--matrix", "--format", "json"]
    told = json.loads(subprocess.run(command, input=scene, capture_output=True, text=True, check=True).stdout)
    letters = {}

    def read(text):
        names = {n: sympy.Symbol(n) for n in re.findall(r"[a-zA-Z_]\w*", text)} | {"sin": sympy.sin, "cos": sympy.cos}
        e = parse_expr(text.replace("^", "**"), local_dict=names)
        return e.replace(lambda f: isinstance(f, (sympy.sin, sympy.cos)),
                         lambda f: letters.setdefault(f, sympy.Symbol(f"t{len(letters)}")))

    return [[read(e) for e in row] for row in told["entries"]], [read(e) for e in told["rhs"]]


def with_flint(matrix, right):
    """Elimination without fractions (Bareiss) over polynomials, quotients in lowest terms."""
    flint = importlib.import_module("flint")
    names = sorted({str(s) for row in [*matrix, right] for e in row for s in e.free_symbols})
    ctx = flint.fmpq_mpoly_ctx.get(names, flint.Ordering.lex)

    def polynomial(e):
        terms = sympy.Poly(e, *map(sympy.Symbol, names)).terms()
        return ctx.from_dict({k: flint.fmpq(int(c.p), int(c.q)) for k, c in terms})

    rows = [[polynomial(e) for e in [*row, r]] for row, r in zip(matrix, right)]
    n = len(rows)

    def solve():
        a = [list(row) for row in rows]
        last = ctx.from_dict({(0,) * len(names): 1})
        for k in range(n):
            pivot = min((i for i in range(k, n) if a[i][k]), key=lambda i: len(a[i][k]))
            a[k], a[pivot] = a[pivot], a[k]
            for i in range(n):
                if i != k:
                    a[i] = [(a[k][k] * a[i][j] - a[i][k] * a[k][j]) / last for j in range(n + 1)]
            last = a[k][k]
        return [(a[i][n] / (g := a[i][n].gcd(a[i][i])), a[i][i] / g) for i in range(n)]

    return solve


def with_pari(matrix, right):
    """`matsolve` over rational functions."""
    pari = importlib.import_module("cypari").pari
    pari.allocatemem(10 ** 9, silent=True)
    text = lambda e: str(e).replace("**", "^")
    names = {str(s): f"{str(s)}_" for row in [*matrix, right] for e in row for s in e.free_symbols}
    own = lambda t: re.sub(r"[a-zA-Z_]\w*", lambda m: names[m[0]], t)
    a = pari("[" + "; ".join(", ".join(own(text(e)) for e in row) for row in matrix) + "]")
    b = pari("[" + "; ".join(own(text(e)) for e in right) + "]")
    return lambda: a.matsolve(b)


def with_symengine(matrix, right):
    """`LUsolve`, and nothing put into lowest terms."""
    symengine = importlib.import_module("symengine")
    n = len(right)
    a = symengine.DenseMatrix(n, n, [symengine.sympify(e) for row in matrix for e in row])
    b = symengine.DenseMatrix(n, 1, [symengine.sympify(e) for e in right])
    return lambda: a.LUsolve(b)


def with_sympy(matrix, right):
    """Elimination over its field of rational functions."""
    from sympy.polys.matrices import DomainMatrix
    n = len(right)
    joined = DomainMatrix.from_Matrix(sympy.Matrix([[*row, r] for row, r in zip(matrix, right)])).to_field()
    a, b = joined[:, :n], joined[:, n:]
    return lambda: a.lu_solve(b)


def median_of(solve, seconds=2.0):
    """Microseconds of one call: the median of what fits into the time."""
    times, end = [], time.perf_counter() + seconds
    while not times or time.perf_counter() < end and len(times) < 10_000:
        start = time.perf_counter()
        solve()
        times.append(time.perf_counter() - start)
    return statistics.median(times) * 1e6


def solved(tool, scene):
    return median_of(tool(*system(scene)))


def derive():
    subprocess.run(["cargo", "build", "--release", "--quiet"], check=True)
    carom = medians("derive", "deriving", "proving", "chain")
    book = ["two-masses", "falling-stick", "pool-balls-elastic", "two-bodies-frictionless", "two-bodies-sticking"]
    rows = [(name, open(f"derivations/book/{name}.json", encoding="utf-8").read(),
             carom[f"deriving {name}"], carom[f"proving {name}"]) for name in book]
    rows += [(f"chain in line, n = {n}", chain(n, False), carom[f"chain_in_line {n}"], None) for n in (4, 8)]
    rows += [(f"chain at any angles, n = {n}", chain(n, True), carom[f"chain_at_any_angles {n}"], None) for n in (2, 3, 4)]
    tools = {"FLINT": with_flint, "PARI/GP": with_pari, "SymEngine": with_symengine, "SymPy": with_sympy}
    print(f"{'us':30} {'derived':>9} {'proved':>9}" + "".join(f"{name:>22}" for name in tools) + "   (times carom's derivation)")
    for name, scene, derived, proved in rows:
        row = f"{name:30} {derived:9.0f} {proved or float('nan'):9.0f}"
        for tool in tools.values():
            try:
                # In a process of its own, which a minute ends.
                with multiprocessing.Pool(1) as pool:
                    theirs = pool.apply_async(solved, (tool, scene)).get(60)
                row += f"{theirs:13.0f} {theirs / derived:7.1f}x"
            except ImportError:
                row += f"{'not installed':>22}"
            except Exception as trouble:
                row += f"{type(trouble).__name__:>22}"
        print(row, flush=True)


def friction():
    """A rod strikes a rough floor: the contact decided and solved, beside a step of Pymunk at the same contact."""
    import pymunk
    carom = medians("friction", "one_contact_in_doubles")
    space = pymunk.Space()
    floor = pymunk.Segment(space.static_body, (-9, 0), (9, 0), 0.01)
    rod = pymunk.Body(1.0, 1 / 12)
    shape = pymunk.Segment(rod, (-0.5, 0), (0.5, 0), 0.01)
    for s in (floor, shape):
        s.friction, s.elasticity = 0.8 ** 0.5, 0.5 ** 0.5
    space.add(floor, rod, shape)

    def reset():
        rod.position, rod.angle, rod.velocity, rod.angular_velocity = (0.3, 0.4), 0.9273, (-1, -1), 0

    def step():
        reset()
        space.step(1e-6)

    with_reset, alone = median_of(step, 1.0), median_of(reset, 1.0)
    step()
    struck = rod.velocity.y > -1
    print(f"Pymunk {pymunk.version}: {with_reset - alone:.2f} us a step, found the contact: {struck}")
    for name, ours in carom.items():
        print(f"{name}: {ours:.3f} us, {(with_reset - alone) / ours:.0f} times less")


{"grade": grade, "derive": derive, "friction": friction}[sys.argv[1] if len(sys.argv) > 1 else "grade"]()
