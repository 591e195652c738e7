"""Small Abaqus and CalculiX decks for the tests: blocks of all kinds of elements."""
import itertools

# Corners of a cell (Abaqus), and its edges in the order of their mid nodes.
HEX = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
EDGES = {8: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
         6: [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
         4: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]}
SIDES = {8: [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)],
         6: [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
         4: [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]}
# A cube as six tetrahedra around its diagonal, and as two wedges.
PARTS = {8: [tuple(range(8))], 6: [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)],
         4: [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]}
KINDS = {'C3D8': (8, False), 'C3D8R': (8, False), 'C3D8I': (8, False), 'C3D20': (8, True), 'C3D20R': (8, True), 'C3D6': (6, False),
         'C3D15': (6, True), 'C3D4': (4, False), 'C3D10': (4, True), 'C3D10M': (4, True), 'C3D10T': (4, True)}


class Block:
    """A block of cells of one kind; nodes are numbered from first_node + 1, elements from first_element + 1."""

    def __init__(self, kind, low, high, n, first_node=0, first_element=0, move=lambda x: x):
        self.kind, (corners, quadratic) = kind, KINDS[kind]
        self.low, self.high = low, high
        self.nodes, self.elements, self.number, self.first_node = {}, {}, {}, first_node
        self.corners = corners
        for cell in itertools.product(*(range(k) for k in n)):
            for part in PARTS[corners]:
                # Doubled integer places: mid nodes have odd ones.
                places = [tuple(2 * (c + d) for c, d in zip(cell, HEX[v])) for v in part]
                if quadratic:
                    places += [tuple((a + b) // 2 for a, b in zip(places[i], places[j])) for i, j in EDGES[corners]]
                label = first_element + len(self.elements) + 1
                self.elements[label] = [self.node(p, n, move) for p in places]

    def node(self, place, n, move):
        if place not in self.number:
            self.number[place] = self.first_node + len(self.number) + 1
            x = [a + (b - a) * p / (2 * k) for a, b, p, k in zip(self.low, self.high, place, n)]
            self.nodes[self.number[place]] = (x, move(x))
        return self.number[place]

    def plane(self, direction, value):
        """Nodes in a plane (before they are moved)."""
        return [k for k, (x, _) in self.nodes.items() if abs(x[direction] - value) < 1e-12]

    def sides(self, direction, value):
        """(element, side from 1) in a plane."""
        nodes, result = set(self.plane(direction, value)), []
        for label, element in self.elements.items():
            for s, side in enumerate(SIDES[self.corners]):
                if all(element[v] in nodes for v in side):
                    result.append((label, s + 1))
        return result

    def text_nodes(self, name=''):
        return f'*NODE{name}\n' + ''.join(f'{k}, {x[0]:.16g}, {x[1]:.16g}, {x[2]:.16g}\n' for k, (_, x) in self.nodes.items())

    def text_elements(self, elset):
        text = f'*ELEMENT, TYPE={self.kind}, ELSET={elset}\n'
        for label, nodes in self.elements.items():
            words = [str(label)] + [str(v) for v in nodes]
            lines = [', '.join(words[i:i + 15]) for i in range(0, len(words), 15)]
            text += ',\n'.join(lines) + '\n'
        return text


def nset(name, nodes, options=''):
    nodes = sorted(nodes)
    return f'*NSET, NSET={name}{options}\n' + ''.join(', '.join(str(v) for v in nodes[i:i + 10]) + ',\n' for i in range(0, len(nodes), 10))


def surface(name, sides):
    return f'*SURFACE, NAME={name}, TYPE=ELEMENT\n' + ''.join(f'{e}, S{s}\n' for e, s in sides)


MATERIAL = '*MATERIAL, NAME=steel\n*ELASTIC\n1000., 0.3\n'
INTERACTION = '*SURFACE INTERACTION, NAME=hard\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n'


def two_blocks(kind='C3D8', n_upper=(2, 2, 2), n_lower=(3, 3, 3), pressure=5., other=None, move=lambda x: x):
    """Two blocks with rollers, the upper one pressed on the lower one: everything in the most usual words."""
    upper = Block(kind, (0, 0, 0), (1, 1, 1), n_upper, move=move)
    lower = Block(other or kind, (0, 0, -1), (1, 1, 0), n_lower, 10000, 10000, move=move)
    text = '** two blocks\n*HEADING\nTwo blocks\n' + upper.text_nodes() + lower.text_nodes()
    text += upper.text_elements('Upper') + lower.text_elements('Lower')
    text += nset('X0', upper.plane(0, 0) + lower.plane(0, 0)) + nset('Y0', upper.plane(1, 0) + lower.plane(1, 0))
    text += nset('BOTTOM', lower.plane(2, -1)) + nset('TOP', upper.plane(2, 1))
    text += surface('SU', upper.sides(2, 0)) + surface('SL', lower.sides(2, 0)) + surface('STOP', upper.sides(2, 1))
    text += MATERIAL + '*SOLID SECTION, ELSET=Upper, MATERIAL=steel\n*SOLID SECTION, ELSET=Lower, MATERIAL=steel\n' + INTERACTION
    text += '*CONTACT PAIR, INTERACTION=hard, TYPE=SURFACE TO SURFACE\nSU, SL\n'
    text += '*BOUNDARY\nX0, 1, 1\nY0, 2, 2\nBOTTOM, 3, 3\n'
    text += '*STEP\n*STATIC\n'
    text += LOAD.format(pressure) if pressure else ''
    text += '*END STEP\n'
    return text, upper, lower


LOAD = '*DSLOAD\nSTOP, P, {}\n'
